/// The parts of a source file in C++ or JavaScript, so that a text can be made of those that it needs. The files are
/// the subjects of engines (impl/engines): what a library is asked there is also what a test for the library asks.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearmiss {

enum class Language { cpp, javascript };

/// A declaration, a statement or a line of the preprocessor that stands in no function, class or list.
struct SourceUnit {
  std::string comment;             ///< the lines of comments above it
  std::string text;                ///< from its first to its last character
  std::vector<std::string> names;  ///< what it declares; empty for a statement
  std::set<std::string> words;     ///< what it mentions, but for members and what other namespaces have
  bool begins_paragraph = false;   ///< an empty line stands above it
  bool in_head = false;            ///< stands before the first comment that follows an empty line
};

/// In the order of the source. Namespaces are transparent.
std::vector<SourceUnit> units_of(std::string_view source, Language language);

/// Which of the units a text with these words needs: what declares them, what that needs, and every statement that
/// stands in the head or mentions a needed declaration that does not.
std::vector<bool> needed_units(const std::vector<SourceUnit>& units, std::set<std::string> words);

/// The words of a piece of source, as those of a unit.
std::set<std::string> words_of_source(std::string_view source, Language language);

/// A piece of source with other words in place of some of its words.
std::string with_words(std::string_view source, Language language,
                       const std::vector<std::pair<std::string_view, std::string>>& replaced);

/// The items of the list that begins at `source` and ends with the bracket that closes it, or with the text: they
/// stand between commas outside of brackets. `angles`: "<" and ">" are brackets too.
std::vector<std::string> items_of_list(std::string_view source, Language language, bool angles = false);

/// The position behind the word `name` and the character `mark` that follows it; npos where they are not there.
std::size_t behind_name(std::string_view source, Language language, std::string_view name, char mark);

}  // namespace nearmiss
