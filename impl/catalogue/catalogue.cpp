#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

#include <fmt/format.h>

#include <algorithm>

#include "impl/catalogue/make_query.hpp"
#include "impl/catalogue/query.hpp"
#include "impl/catalogue/query_ids.hpp"

namespace nearmiss {

namespace {

constexpr QueryId all_ids[] = {
#define NEARMISS_QUERY(query) QueryId::query,
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
};

constexpr bool links_are_queries(std::span<const Link> links) {
  return std::ranges::all_of(links,
                             [](const Link& l) { return std::ranges::find(all_ids, l.to) != std::end(all_ids); });
}

template <class Inputs>
Query checked_query(QueryId id, std::string_view name) {
  static_assert(links_are_queries(Inputs::traits.links), "a link names a query that the catalogue does not have");
  return make_query<Inputs>(id, name);
}

}  // namespace

std::string Invalid::text() const { return fmt::format("{} is {}: it must be {}", field, value, rule); }

std::string_view name_of(Kind kind) {
  switch (kind) {
    case Kind::decision: return "decision";
    case Kind::impact: return "impact";
    case Kind::points: return "points";
    case Kind::depth: return "depth";
    case Kind::direction: return "direction";
    case Kind::measure: return "measure";
  }
  return "?";
}

std::string_view name_of(Tie tie) {
  switch (tie) {
    case Tie::position: return "position";
    case Tie::normal: return "normal";
    case Tie::depth: return "depth";
    case Tie::weight: return "weight";
    case Tie::index: return "index";
    case Tie::cone: return "cone";
  }
  return "?";
}

std::string_view name_of(Role role) {
  switch (role) {
    case Role::inherited: return "number";
    case Role::position: return "position";
    case Role::velocity: return "velocity";
    case Role::size: return "size";
    case Role::direction: return "direction";
    case Role::rotation: return "rotation";
    case Role::time: return "time";
    case Role::offset: return "offset";
    case Role::normal: return "normal";
    case Role::depth: return "depth";
    case Role::distance: return "distance";
    case Role::weight: return "weight";
    case Role::flag: return "flag";
    case Role::index: return "index";
    case Role::count: return "count";
  }
  return "?";
}

std::span<const Query> catalogue() {
  static const std::vector<Query> queries = [] {
    std::vector<Query> all = {
#define NEARMISS_QUERY(query) checked_query<inputs::query<double>>(QueryId::query, #query),
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
    };
    for (std::size_t i = 0; i < all.size(); ++i) all[i].index = i;
    return all;
  }();
  return queries;
}

const Query& query_of(QueryId id) {
  return *std::ranges::find_if(catalogue(), [id](const Query& q) { return q.id == id; });
}

const Query* find_query(std::string_view name) {
  for (const Query& q : catalogue()) {
    if (q.name == name) return &q;
  }
  return nullptr;
}

}  // namespace nearmiss
