/// Prints the fuzz targets that can ask the subjects of NEARMISS_ADD, one a line, without fuzz_.
#include <algorithm>
#include <cstdio>

#include "corpus/storage/fuzz_target.hpp"
#include "impl/subject/provenance.hpp"
#include "impl/subject/subject.hpp"

int main() {
  using namespace nearmiss;
  const std::vector<std::string> names = added_subjects();
  const auto is_offered = [&](const Query* query) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const Subject* s = find_subject(name);  // none where the subject is isolated: targets do not include it
      return s != nullptr && s->offering(query->name).offer != Offer::not_offered;
    });
  };
  for (const FuzzTarget& target : fuzz_targets()) {
    if (std::any_of(target.queries.begin(), target.queries.end(), is_offered))
      std::printf("%.*s\n", int(target.name.size()), target.name.data());
  }
}
