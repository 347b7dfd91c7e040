/// Prints the queries that the subjects of NEARMISS_ADD offer, one a line: the fuzz targets that can ask them.
#include <algorithm>
#include <cstdio>

#include "impl/catalogue/query.hpp"
#include "impl/subject/provenance.hpp"
#include "impl/subject/subject.hpp"

int main() {
  using namespace nearmiss;
  for (const Query& query : catalogue()) {
    const auto names = added_subjects();
    const bool offered = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const Subject* s = find_subject(name);  // none where the subject is isolated: targets do not include it
      return s != nullptr && s->offering(query.name).offer != Offer::not_offered;
    });
    if (offered) std::printf("%.*s\n", int(query.name.size()), query.name.data());
  }
}
