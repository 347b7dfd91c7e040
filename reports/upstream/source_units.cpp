#include "reports/upstream/source_units.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace nearmiss {

namespace {

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$'; }

struct Token {
  enum class Kind { word, number, text, comment, directive, mark, end };
  Kind kind;
  std::size_t begin, end;
};

/// Reads a source token by token. A mark is a single character, but for "::", "->", "=>" and "...".
class Scanner {
 public:
  Scanner(std::string_view source, Language language) : source_(source), language_(language) {}

  Token next() {
    while (at_ < source_.size() && std::isspace(static_cast<unsigned char>(source_[at_])) != 0) ++at_;
    const std::size_t begin = at_;
    const Token::Kind kind = begin == source_.size() ? Token::Kind::end : skip();
    if (kind != Token::Kind::comment) before_ = source_.substr(begin, at_ - begin);
    return {kind, begin, at_};
  }
  std::string_view text(const Token& t) const { return source_.substr(t.begin, t.end - t.begin); }

 private:
  bool is_ahead(std::string_view text) const { return source_.substr(at_).starts_with(text); }
  Token::Kind skip() {
    const char c = source_[at_];
    if (is_ahead("//")) return up_to("\n", Token::Kind::comment);
    if (is_ahead("/*")) return past("*/", Token::Kind::comment);
    if (c == '#' && language_ == Language::cpp) return up_to("\n", Token::Kind::directive);
    if (c == '"' || c == '\'' || c == '`') return past_quote(c);
    if (c == '/' && language_ == Language::javascript && (before_ == "(" || before_ == "=" || before_ == ","))
      return past_quote(c);
    if (is_of_word(c)) return past_word();
    for (const std::string_view mark : {"...", "::", "->", "=>"}) {
      if (is_ahead(mark)) return at_ += mark.size(), Token::Kind::mark;
    }
    return ++at_, Token::Kind::mark;
  }
  Token::Kind up_to(std::string_view end, Token::Kind kind) {
    at_ = std::min(source_.find(end, at_), source_.size());
    return kind;
  }
  Token::Kind past(std::string_view end, Token::Kind kind) {
    up_to(end, kind);
    at_ = std::min(at_ + end.size(), source_.size());
    return kind;
  }
  /// A string, or a regular expression, in which a quote may stand between brackets.
  Token::Kind past_quote(char quote) {
    bool in_brackets = false;
    for (++at_; at_ < source_.size() && (source_[at_] != quote || in_brackets); ++at_) {
      if (quote == '/' && (source_[at_] == '[' || source_[at_] == ']')) in_brackets = source_[at_] == '[';
      if (source_[at_] == '\\') ++at_;
    }
    at_ = std::min(at_ + 1, source_.size());
    return Token::Kind::text;
  }
  Token::Kind past_word() {
    const bool is_number = std::isdigit(static_cast<unsigned char>(source_[at_])) != 0;
    while (at_ < source_.size() &&
           (is_of_word(source_[at_]) || (is_number && (source_[at_] == '.' || source_[at_] == '\''))))
      ++at_;
    return is_number ? Token::Kind::number : Token::Kind::word;
  }

  std::string_view source_;
  Language language_;
  std::size_t at_ = 0;
  std::string_view before_{};
};

/// All tokens but comments.
std::vector<Token> tokens_of(std::string_view source, Language language) {
  Scanner scanner(source, language);
  std::vector<Token> all;
  for (Token t = scanner.next(); t.kind != Token::Kind::end; t = scanner.next()) {
    if (t.kind != Token::Kind::comment) all.push_back(t);
  }
  return all;
}

std::string_view text_of(std::string_view source, const Token& t) { return source.substr(t.begin, t.end - t.begin); }

int change_of_depth(std::string_view mark) {
  if (mark == "(" || mark == "[" || mark == "{") return 1;
  return mark == ")" || mark == "]" || mark == "}" ? -1 : 0;
}

/// Whether nothing but a comment follows on the line.
bool ends_line(std::string_view source, std::size_t at) {
  while (at < source.size() && source[at] == ' ') ++at;
  return at == source.size() || source[at] == '\n' || source.substr(at).starts_with("//");
}

bool is_after_empty_line(std::string_view source, std::size_t at) { return source.substr(0, at).ends_with("\n\n"); }

/// The names that a declaration in C++ declares.
class CppNames {
 public:
  explicit CppNames(std::string_view text) : text_(text), tokens_(tokens_of(text, Language::cpp)) {}

  std::vector<std::string> names() {
    skip_template();
    if (tokens_[0].kind == Token::Kind::directive || is("static_assert") || is("extern"))
      return {std::string(at(first_))};  // which no other unit mentions
    if (is("class") || is("struct")) return {std::string(at(first_ + 1))};
    const bool is_using = is("using");
    std::vector<std::string> names;
    std::string_view last;
    int depth = 0;
    for (std::size_t i = first_; i < tokens_.size(); ++i) {
      const std::string_view t = at(i);
      if (depth == 0 && (change_of_depth(t) > 0 || t == "=" || t == ";" || t == ",")) {
        if (!last.empty()) names.emplace_back(last);
        if (t == "(" || (is_using && t == "=")) return names;  // a function, an alias
        last = {};
      }
      depth += change_of_depth(t);
      if (depth == 0 && tokens_[i].kind == Token::Kind::word && (names.empty() || at(i - 1) == "," || is_using))
        last = t;
    }
    return names;
  }

 private:
  std::string_view at(std::size_t i) const { return i < tokens_.size() ? text_of(text_, tokens_[i]) : ""; }
  bool is(std::string_view word) const { return at(first_) == word; }
  void skip_template() {
    if (!is("template")) return;
    int depth = 0;
    do {
      ++first_;
      depth += at(first_) == "<" ? 1 : at(first_) == ">" ? -1 : 0;
    } while (depth > 0 && first_ < tokens_.size());
    ++first_;
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::size_t first_ = 0;
};

/// The names that JavaScript declares.
class JavascriptNames {
 public:
  explicit JavascriptNames(std::string_view text) : text_(text), tokens_(tokens_of(text, Language::javascript)) {}

  /// By a unit.
  std::vector<std::string> declared() {
    std::size_t first = at(0) == "export" ? 1 : 0;
    if (at(first) == "async") ++first;
    if (at(first) == "function" || at(first) == "class") return {std::string(at(first + 1))};
    if (at(first) == "import") add_pattern(first + 1, [&](std::size_t i) { return at(i) == "from"; });
    if (at(first) == "const" || at(first) == "let") add_declarations(first);
    return std::move(names_);
  }
  /// Inside of a unit: its parameters and local variables.
  std::vector<std::string> local() {
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
      if (i > 1 && (at(i) == "const" || at(i) == "let")) add_declarations(i);
      if (at(i) == "(" && holds_parameters(i)) add_parameters(i);
    }
    return std::move(names_);
  }

 private:
  std::string_view at(std::size_t i) const { return i < tokens_.size() ? text_of(text_, tokens_[i]) : ""; }
  std::size_t closing(std::size_t i) const {
    int depth = 0;
    do depth += change_of_depth(at(i++));
    while (depth > 0 && i < tokens_.size());
    return i - 1;
  }
  bool holds_parameters(std::size_t i) const {
    const std::string_view next = at(closing(i) + 1);
    return next == "=>" || (next == "{" && (at(i - 1) == "constructor" || at(i - 2) == "function"));
  }
  void add_parameters(std::size_t i) {
    const std::size_t end = closing(i);
    for (++i; i < end; ++i) i = add_pattern(i, [&](std::size_t k) { return k >= end; });
  }
  /// The names of patterns such as { a, b: c } up to one of the ends; returns its position. A default value has none.
  template <class IsEnd>
  std::size_t add_pattern(std::size_t i, IsEnd is_end) {
    for (; i < tokens_.size() && !is_end(i); ++i) {
      if (at(i) == "=") {
        for (++i; !is_end(i) && at(i) != "," && change_of_depth(at(i)) >= 0; ++i) {
          if (change_of_depth(at(i)) > 0) i = closing(i);
        }
        --i;
      } else if (tokens_[i].kind == Token::Kind::word && at(i) != "as" && at(i + 1) != "as" && at(i + 1) != ":") {
        names_.emplace_back(at(i));
      }
    }
    return i;
  }
  /// Of `const` or `let`, with all of its declarators.
  void add_declarations(std::size_t i) {
    do {
      i = add_pattern(i + 1, [&](std::size_t k) { return at(k) == "=" || at(k) == "of" || at(k) == ";"; });
      for (; i < tokens_.size() && at(i) != "," && at(i) != ";" && change_of_depth(at(i)) >= 0; ++i) {
        if (change_of_depth(at(i)) > 0) i = closing(i);
      }
    } while (at(i) == ",");
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::vector<std::string> names_;
};

/// Cuts a source into its units.
class Cutter {
 public:
  Cutter(std::string_view source, Language language)
      : source_(source), language_(language), scanner_(source, language) {}

  std::vector<SourceUnit> units() {
    for (Token t = scanner_.next(); t.kind != Token::Kind::end; t = scanner_.next()) take(t);
    return std::move(units_);
  }

 private:
  void take(const Token& t) {
    const bool is_between = begin_ == npos;
    if (t.kind == Token::Kind::comment) {
      if (is_between) take_comment(t);
      return;
    }
    if (is_between && skips_namespace(t)) return;
    if (is_between) {
      begin_ = t.begin;
      begins_paragraph_ = begins_paragraph_ || is_after_empty_line(source_, t.begin);
    }
    const std::string_view text = scanner_.text(t);
    depth_ += t.kind == Token::Kind::mark ? change_of_depth(text) : 0;
    const bool may_end = t.kind == Token::Kind::directive || text == ";" || text == "}";
    if (depth_ == 0 && may_end && ends_line(source_, t.end)) end(t.end);
  }
  void take_comment(const Token& t) {
    if (is_after_empty_line(source_, t.begin)) {
      comment_.clear();
      begins_paragraph_ = true;
      in_head_ = in_head_ && units_.empty();
    }
    if (t.begin == 0 || source_[t.begin - 1] == '\n') comment_.append(scanner_.text(t)).append("\n");
  }
  /// "namespace {" and the bracket that closes it.
  bool skips_namespace(const Token& t) {
    if (language_ != Language::cpp) return false;
    if (scanner_.text(t) == "}") return true;
    if (scanner_.text(t) != "namespace") return false;
    scanner_.next();
    return true;
  }
  void end(std::size_t at) {
    SourceUnit u;
    u.comment = std::exchange(comment_, {});
    u.text = source_.substr(begin_, at - begin_);
    u.names = language_ == Language::cpp ? CppNames(u.text).names() : JavascriptNames(u.text).declared();
    u.words = words_of_source(u.text, language_);
    u.in_head = in_head_;
    u.begins_paragraph = std::exchange(begins_paragraph_, false);
    units_.push_back(std::move(u));
    begin_ = npos;
  }

  static constexpr std::size_t npos = std::string_view::npos;
  std::string_view source_;
  Language language_;
  Scanner scanner_;
  std::vector<SourceUnit> units_;
  std::string comment_;
  std::size_t begin_ = npos;  ///< of the unit; npos between two units
  int depth_ = 0;
  bool in_head_ = true, begins_paragraph_ = false;
};

bool declares_one_of(const SourceUnit& u, const std::set<std::string>& words) {
  return std::any_of(u.names.begin(), u.names.end(), [&](const std::string& n) { return words.contains(n); });
}

}  // namespace

std::vector<SourceUnit> units_of(std::string_view source, Language language) {
  return Cutter(source, language).units();
}

std::vector<bool> needed_units(const std::vector<SourceUnit>& units, std::set<std::string> words) {
  std::vector<bool> needed(units.size());
  std::set<std::string> declared;  // by needed units outside of the head
  for (bool changes = true; changes;) {
    changes = false;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const SourceUnit& u = units[i];
      const bool is_statement = u.names.empty();
      const bool concerns =
          std::any_of(u.words.begin(), u.words.end(), [&](const auto& w) { return declared.contains(w); });
      if (needed[i] || !(is_statement ? u.in_head || concerns : declares_one_of(u, words))) continue;
      needed[i] = changes = true;
      words.insert(u.words.begin(), u.words.end());
      if (!u.in_head) declared.insert(u.names.begin(), u.names.end());
    }
  }
  return needed;
}

std::set<std::string> words_of_source(std::string_view source, Language language) {
  std::set<std::string> words;
  std::string_view before;
  for (const Token& t : tokens_of(source, language)) {
    const std::string_view text = text_of(source, t);
    const bool is_foreign = before == "." || before == "->" || before == "::";
    if (t.kind == Token::Kind::word && !is_foreign) words.emplace(text);
    before = text;
  }
  if (language == Language::javascript) {
    for (const std::string& name : JavascriptNames(source).local()) words.erase(name);
  }
  return words;
}

std::string with_words(std::string_view source, Language language,
                       const std::vector<std::pair<std::string_view, std::string>>& replaced) {
  std::string text;
  std::size_t at = 0;
  for (const Token& t : tokens_of(source, language)) {
    if (t.kind != Token::Kind::word) continue;
    for (const auto& [word, other] : replaced) {
      if (text_of(source, t) != word) continue;
      text.append(source.substr(at, t.begin - at)).append(other);
      at = t.end;
    }
  }
  return text.append(source.substr(at));
}

std::vector<std::string> items_of_list(std::string_view source, Language language, bool angles) {
  std::vector<std::string> items;
  int depth = 0;
  std::size_t begin = 0, end = 0;
  for (const Token& t : tokens_of(source, language)) {
    const std::string_view text = text_of(source, t);
    depth += change_of_depth(text) + (angles ? (text == "<") - (text == ">") : 0);
    if (depth < 0) break;
    if (end <= begin && text != ",") begin = t.begin;
    if (depth == 0 && text == ",") {
      items.emplace_back(source.substr(begin, end - begin));
      begin = end = t.end;
    } else {
      end = t.end;
    }
  }
  if (end > begin) items.emplace_back(source.substr(begin, end - begin));
  return items;
}

std::size_t behind_name(std::string_view source, Language language, std::string_view name, char mark) {
  const std::vector<Token> tokens = tokens_of(source, language);
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const bool follows = text_of(source, tokens[i + 1]) == std::string_view(&mark, 1);
    if (follows && text_of(source, tokens[i]) == name) return tokens[i + 1].end;
  }
  return std::string_view::npos;
}

}  // namespace nearmiss
