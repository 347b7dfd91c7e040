/// Turns an adapter into a Subject: pairs it with every line of the catalogue.
///
/// An adapter is a struct with
///   using Number = double;  // or float: the scalar in which the library computes
///   static std::string version();
///   static auto answer(const inputs::QUERY<Number>&);  // one for each query that it answers
/// and, optionally,
///   template <class Q> static collide::Contract contract();  // the promise for inputs Q
///   template <class Q> static std::string equivalence();     // "" or the equivalent operation that it uses
///   template <class Q> static std::string left_out();        // "" or the members that it does not give, and why
///   template <class Q> static std::string why_not();         // why a query is not offered
///   template <class Q> static nearmiss::Preconditions needs();
#pragma once

#include "impl/subject/offering.hpp"
#include "nearmiss/catalogue_inputs.hpp"  // written by CMake from impl/catalogue/catalogue.def

namespace nearmiss {

template <class Adapter>
Subject bind(std::string name) {
  using Number = typename Adapter::Number;
  Subject s = without_offerings<Adapter>(std::move(name));
#define NEARMISS_QUERY(query) s.offerings.push_back(offering_of<Adapter, inputs::query<Number>>(#query));
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
  return s;
}

}  // namespace nearmiss
