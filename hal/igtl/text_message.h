#pragma once

#include <string>

#include "base/result.h"
#include "hal/igtl/header.h"

namespace orthonav::igtl {

/// The text of a STRING message, in ASCII or UTF-8. An Error if its length is wrong or it has
/// another encoding.
Result<std::string> text_in(const Header& header, Bytes body);

/// Receives clients' texts.
class TextListener {
 public:
  virtual ~TextListener() = default;
  /// Called on the server's thread, which waits meanwhile. `client` is the client's address.
  virtual void said(const std::string& client, const std::string& device,
                    const std::string& text) = 0;
};

}  // namespace orthonav::igtl
