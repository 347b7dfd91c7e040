#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/output.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// The templates are those of Nearmiss's own files. Words between "@" are filled in. A line that begins with "@own@",
/// "@kit@", "@oss@" or "@cfl@" is kept only for Nearmiss itself, for a library, for OSS-Fuzz or for ClusterFuzzLite.
fs::path templates_folder() { return fs::path(source_folder()) / "fuzz" / "oss-fuzz" / "templates"; }

struct Kit {
  std::map<std::string, std::string> words;  ///< the text for each word
  bool own;                                  ///< for Nearmiss itself

  bool keeps(std::string& line, bool for_oss_fuzz) const {
    const std::pair<std::string_view, bool> marks[] = {
        {"@own@", own}, {"@kit@", !own}, {"@oss@", for_oss_fuzz}, {"@cfl@", !for_oss_fuzz}};
    for (bool marked = true; marked;) {
      marked = false;
      for (const auto& [mark, kept] : marks) {
        if (!line.starts_with(mark)) continue;
        if (!kept) return false;
        line.erase(0, mark.size());
        marked = true;
      }
    }
    return true;
  }
  std::string filled(std::string line) const {
    for (const auto& [word, text] : words) {
      const std::string place = "@" + word + "@";
      for (std::size_t at = 0; (at = line.find(place, at)) != std::string::npos; at += text.size())
        line.replace(at, place.size(), text);
    }
    return line;
  }
  std::string made(const std::string& name, bool for_oss_fuzz) const {
    std::string text;
    std::istringstream lines(read_file(templates_folder() / name));
    for (std::string line; std::getline(lines, line);) {
      if (keeps(line, for_oss_fuzz)) text += filled(line) + "\n";
    }
    return text;
  }
  void write(const fs::path& folder) const {
    for (const bool oss_fuzz : {false, true}) {
      const fs::path into = folder / (oss_fuzz ? "oss-fuzz" : ".clusterfuzzlite");
      make_folder(into);
      for (const char* name : {"project.yaml", "Dockerfile", "build.sh"}) write_file(into / name, made(name, oss_fuzz));
      fs::permissions(into / "build.sh", fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
    }
    make_folder(folder / ".github" / "workflows");
    for (const char* name : {"cflite_pr.yml", "cflite_batch.yml", "cflite_cron.yml"})
      write_file(folder / ".github" / "workflows" / name, made(name, false));
    if (!own) write_file(folder / "README.md", made("README.md", false));
  }
};

/// The name of a project of OSS-Fuzz: small letters, digits, "-" and "_".
std::string project_name(std::string name) {
  for (char& c : name) {
    c = char(std::tolower(static_cast<unsigned char>(c)));
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '-';
  }
  return name;
}

/// The folder above `file` that is a clone of git; otherwise the folder of `file`.
fs::path repository_of(const fs::path& file) {
  for (fs::path folder = file.parent_path();; folder = folder.parent_path()) {
    if (fs::exists(folder / ".git")) return folder;
    if (folder == folder.parent_path()) return file.parent_path();
  }
}

/// Whether the text of a CMake file calls nearmiss_add_subject(NAME ...).
bool adds(const std::string& text, const std::string& name) {
  const std::regex call(R"(nearmiss_add_subject\(\s*"?([^"\s)]+))");
  return std::any_of(std::sregex_iterator(text.begin(), text.end(), call), std::sregex_iterator(),
                     [&](const std::smatch& found) { return found[1] == name; });
}

/// Accepts what can stand in a Dockerfile and in YAML without quotes.
CLI::Validator plain_text(const std::string& what, const std::string& pattern) {
  return CLI::Validator(
      [what, pattern](const std::string& text) {
        return std::regex_match(text, std::regex(pattern)) ? "" : "'" + text + "' is no " + what;
      },
      "");
}

class OssFuzzCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "oss-fuzz",
        "write the files that fuzz your library on OSS-Fuzz and ClusterFuzzLite",
        {"SUBJECT is your library's name in the CMake file that adds it (docs/bring-your-own.md). Writes into DIR, for "
         "your library's repository: .clusterfuzzlite/ and .github/workflows/, with which ClusterFuzzLite fuzzes each "
         "pull request and every night; oss-fuzz/, a project for Google's machines; and README.md, which shows the "
         "steps. Each builds Nearmiss's fuzz targets for the queries that your adapter answers.",
         "Without the URLs and the address, the files have OWNER in their place; the command names what is left to "
         "fill in.",
         "For a tier of collide it writes the files of Nearmiss's own repository."},
        {{"0", "Done."}, {"2", "No such subject, the folder is not empty, or a file cannot be written."}},
        {{"nearmiss oss-fuzz --subject skim --out kit", "The kit for the library that this build adds."},
         {"nearmiss oss-fuzz --subject skim --add ../skim/nearmiss.cmake --out kit "
          "--repository https://github.com/me/skim",
          "For a library that this build does not have."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("-s,--subject", subject_, "Your library")
        ->required()
        ->type_name("SUBJECT")
        ->check(plain_text("name of a subject", R"([A-Za-z0-9._+-]+)"));
    add_output_folder(app, out_, "The folder to write; new or empty");
    app.get_option("--out")->required();
    app.add_option("--add", add_, "The CMake file that adds the subject. Default: that of this build (NEARMISS_ADD)")
        ->type_name("FILE");
    const std::string url = R"(https://[A-Za-z0-9._~:/-]+)";
    app.add_option("--repository", repository_, "The URL from which your library's repository is cloned")
        ->type_name("URL")
        ->check(plain_text("URL that begins with https://", url));
    app.add_option("--nearmiss", nearmiss_, "The URL from which Nearmiss is cloned")
        ->type_name("URL")
        ->check(plain_text("URL that begins with https://", url));
    app.add_option("--contact", contact_, "The address to which OSS-Fuzz sends its reports")
        ->type_name("EMAIL")
        ->check(plain_text("address", R"([A-Za-z0-9._+-]+@[A-Za-z0-9-]+\.[A-Za-z0-9.-]+)"));
  }
  int run(const CLI::App&) override {
    const Kit kit = chosen_kit();
    if (fs::exists(out_) && (!fs::is_directory(out_) || !fs::is_empty(out_)))
      throw BadInput(fmt::format("{}: is not empty: the files go into a new folder", out_));
    kit.write(out_);
    say("written: {}, for {}\n", path_text(out_), subject_);
    std::string left;
    for (const char* word : {"nearmiss", "repository", "contact"}) {
      if (kit.words.at(word).find("OWNER") != std::string::npos)
        left += fmt::format("{}--{}", left.empty() ? "" : ", ", word);
    }
    if (!left.empty()) say("left to fill in, where OWNER stands, or by these options: {}\n", left);
    return 0;
  }

 private:
  Kit chosen_kit() const {
    const Subject* known = find_subject(subject_);
    const bool own = known != nullptr && known->own;
    const std::string project = own ? "nearmiss" : project_name(subject_);
    const std::string nearmiss = nearmiss_.empty() ? "https://github.com/OWNER/nearmiss" : nearmiss_;
    const std::string repository = !repository_.empty() ? repository_
                                   : own                ? nearmiss
                                                        : "https://github.com/OWNER/" + project;
    return {{{"subject", subject_},
             {"project", project},
             {"add", own ? "" : added_by()},
             {"nearmiss", nearmiss},
             {"repository", repository},
             {"contact", contact_.empty() ? "OWNER@example.org" : contact_}},
            own};
  }
  /// The CMake file that adds the subject, relative to its repository.
  std::string added_by() const {
    std::vector<fs::path> files;
    if (!add_.empty()) {
      files.push_back(add_);
    } else {
      for (std::string_view rest = NEARMISS_ADDED_FILES; !rest.empty();) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        files.push_back(fs::path(source_folder()) / rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
    }
    for (const fs::path& file : files) {
      if (!adds(read_file(file), subject_)) continue;
      const fs::path absolute = fs::canonical(file);
      const std::string relative = fs::relative(absolute, repository_of(absolute)).string();
      if (!std::regex_match(relative, std::regex(R"([A-Za-z0-9._/+-]+)")))
        throw BadInput(fmt::format("{}: its name has characters that a script cannot hold plainly", relative));
      return relative;
    }
    if (!add_.empty()) throw BadInput(fmt::format("{}: it adds no subject '{}'", add_, subject_));
    throw BadInput(
        fmt::format("no file of this build adds '{}': name the CMake file that does by --add "
                    "(docs/bring-your-own.md)",
                    subject_));
  }

  std::string subject_, out_, add_, repository_, nearmiss_, contact_;
};

}  // namespace

std::unique_ptr<Command> oss_fuzz_command() { return std::make_unique<OssFuzzCommand>(); }

}  // namespace nearmiss
