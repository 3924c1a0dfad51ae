#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "hal/net/token.h"

namespace orthonav::tools {

/// Where a page is served, and who may read it. At an address that other machines can reach, a
/// request needs a token; the protocol is plain HTTP, so anyone on the network path can read it.
class WebAccess {
 public:
  /// `at`: "PORT" for this machine only, or "ADDRESS:PORT". `token_file` holds the token
  /// (`net::Token::of`). Empty: anyone who reaches the port may read. Refuses an address that other
  /// machines can reach without a token.
  static Result<WebAccess> of(const std::string& at, const std::string& token_file);

  [[nodiscard]] const std::string& host() const { return host_; }
  [[nodiscard]] int port() const { return port_; }  ///< 0: any that is free
  [[nodiscard]] bool asks_for_a_token() const { return token_.is_asked_for(); }
  /// The first URL for a browser, with the token. If served at all addresses of this machine, the
  /// machine's name is used.
  [[nodiscard]] std::string url(int port) const;
  [[nodiscard]] bool is_token(std::string_view text) const { return token_.is(text); }
  /// Whether a request with these headers may read: it has the token as a cookie, or, without a
  /// token, its Host is this machine itself, not another site's name that resolves to it.
  [[nodiscard]] bool lets_in(std::string_view host, std::string_view cookies) const;
  /// The cookie for a browser that sent the token: only for this site, and inaccessible to scripts.
  [[nodiscard]] std::string cookie() const;

 private:
  std::string host_ = "127.0.0.1";
  std::string seen_as_ = host_;  ///< by browsers
  int port_ = 0;
  net::Token token_;
};

}  // namespace orthonav::tools
