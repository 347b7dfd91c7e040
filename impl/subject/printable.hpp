/// Text that comes from elsewhere, for people and for JSON.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// For a terminal: what it would act on, and bytes that are no UTF-8, as \xHH; characters that change the direction of
/// writing or break lines as \u{HHHH}.
std::string printable(std::string_view text);

}  // namespace nearmiss
