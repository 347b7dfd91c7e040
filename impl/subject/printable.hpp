/// Makes text from other programs safe to print.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// `text` without effect on a terminal: control characters and bytes that are not UTF-8 become \xHH; characters that
/// change the writing direction or break lines become \u{HHHH}.
std::string printable(std::string_view text);

}  // namespace nearmiss
