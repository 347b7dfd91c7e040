/// Writes pages that contain their scripts and their data.
#pragma once

#include <string>
#include <string_view>

namespace nearmiss {

/// Replaces the first `mark` in the page by `text`. Throws std::logic_error where the page has none.
void put_in_page(std::string& page, std::string_view mark, std::string_view text);

}  // namespace nearmiss
