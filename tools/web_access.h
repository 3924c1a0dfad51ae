#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace orthonav::tools {

/// Where a page is served, and who may read it. At an address that other machines reach, a request
/// must bring a token; the protocol is plain HTTP, so whoever is on the way can read it.
class WebAccess {
 public:
  /// `at`: "PORT" of this machine alone, or "ADDRESS:PORT". `token_file` holds the token, 16 to 128
  /// letters, digits, '-' and '_', and must be readable by its owner alone; where there is no such
  /// file, it is made with a token at random. Empty: whoever reaches the port may read. Refuses an
  /// address of other machines without a token.
  static Result<WebAccess> of(const std::string& at, const std::string& token_file);

  [[nodiscard]] const std::string& host() const { return host_; }
  [[nodiscard]] int port() const { return port_; }  ///< 0: any that is free
  [[nodiscard]] bool asks_for_a_token() const { return !token_.empty(); }
  /// Where a browser goes first, with the token. What is served at every address of this machine
  /// is found by the machine's name.
  [[nodiscard]] std::string url(int port) const;
  /// In constant time for every text of the right length.
  [[nodiscard]] bool is_token(std::string_view text) const;
  /// Whether a request with these headers may read: it has the token as a cookie, or, where none is
  /// asked for, it comes from a page of this machine itself, and of no site whose name leads here.
  [[nodiscard]] bool lets_in(std::string_view host, std::string_view cookies) const;
  /// What a browser that brought the token keeps: for this site alone, and out of scripts' reach.
  [[nodiscard]] std::string cookie() const;

 private:
  std::string host_ = "127.0.0.1";
  std::string seen_as_ = host_;  ///< by browsers
  int port_ = 0;
  std::string token_;
};

}  // namespace orthonav::tools
