#include "reports/triage/causes/shares.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace nearmiss {

using boost::math::binomial;

double proved_at_least(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : binomial::find_lower_bound_on_p(double(whole), double(part), error_of_a_share);
}

double proved_at_most(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1 : binomial::find_upper_bound_on_p(double(whole), double(part), error_of_a_share);
}

}  // namespace nearmiss
