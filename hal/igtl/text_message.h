#pragma once

#include <string>

#include "base/result.h"
#include "hal/igtl/header.h"

namespace orthonav::igtl {

/// What a STRING says, in ASCII or UTF-8. An Error where its length is not what it states, or it
/// is encoded in another way.
Result<std::string> text_in(const Header& header, Bytes body);

/// Hears what clients say.
class TextListener {
 public:
  virtual ~TextListener() = default;
  /// On the server's thread, which waits meanwhile. `client` is its address.
  virtual void said(const std::string& client, const std::string& device,
                    const std::string& text) = 0;
};

}  // namespace orthonav::igtl
