/// Encodes text of others, such as a subject's version, its standard error or a name in a file, for the place where it
/// goes. Each place has one function; whatever the text is, it means nothing there but itself. Terminal lines are
/// encoded by printable() (impl/subject/printable.hpp), JSON by pretty_json().
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// For a terminal: as printable(), but line breaks stay.
std::string for_terminal(std::string_view text);

/// For a comment of C and C++, of both forms: it ends no comment and begins none, goes on in no other line, and has no
/// trigraph.
std::string in_c_comment(std::string_view text);

/// A string literal of C and C++, with its quotes. It has the bytes of the text.
std::string c_string(std::string_view text);

/// For a sentence or the cell of a table in Markdown.
std::string in_markdown(std::string_view text);

/// A block of code in Markdown, with its fences. `language` is a word, or empty.
std::string markdown_block(std::string_view text, std::string_view language);

/// JSON or JavaScript for a script element of HTML: the text can neither end the element nor begin a comment there. In
/// strings of JavaScript and JSON it means the same.
std::string in_html_script(std::string_view text);

/// Text or an attribute of XML 1.0. Characters that XML forbids are replaced.
std::string in_xml(std::string_view text);

/// A cell of a CSV file. A spreadsheet takes it for no formula.
std::string csv_cell(std::string_view text);

/// A word of a shell's command line, in single quotes where it holds other than plain characters.
std::string shell_quoted(const std::string& word);
/// The words of a command line that shell_quoted() wrote; empty where a shell would do more with it than to take words.
std::optional<std::vector<std::string>> words_of_shell(std::string_view line);

}  // namespace nearmiss
