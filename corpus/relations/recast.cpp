#include "corpus/relations/recast.hpp"

#include <algorithm>

#include "corpus/relations/operands.hpp"

namespace nearmiss::metamorphic {

namespace {

/// The name in this query of a field of the linked query; empty if the beginning of the name differs.
std::optional<std::string> renamed_by(const Link::Renamed& r, const std::string& name) {
  const bool begins = !r.there.empty() && name.starts_with(r.there);
  if (!begins || (name.size() > r.there.size() && name[r.there.size()] != '.')) return std::nullopt;
  return std::string(r.here) + name.substr(r.there.size());
}

std::string name_here(const std::string& name, const Link& link, std::span<const Link::Renamed> renamed) {
  for (const auto& list : {renamed, std::span<const Link::Renamed>(link.renamed)}) {
    for (const Link::Renamed& r : list) {
      if (const auto here = renamed_by(r, name)) return *here;
    }
  }
  return name;
}

}  // namespace

const Link* link_of(const Case& c, Link::Kind kind) {
  const auto& links = c.query->traits.links;
  const auto found = std::find_if(links.begin(), links.end(), [&](const Link& l) { return l.kind == kind; });
  return found == links.end() ? nullptr : &*found;
}

Case recast(const Case& c, const Link& link, std::span<const Link::Renamed> renamed) {
  Case other{&query_of(link.to), c.scalar, {}, c.origin, c.seed, c.index, c.moves};
  for (const Field& f : other.fields()) {
    const std::string name = name_here(f.name, link, renamed);
    const bool w = f.role == Role::rotation && last(f.name) == "w";
    const double otherwise = f.name == link.set.name ? link.set.value : w ? 1.0 : 0.0;
    other.values.push_back(f.name != link.set.name && has(c, name) ? value(c, name) : otherwise);
  }
  return other;
}

}  // namespace nearmiss::metamorphic
