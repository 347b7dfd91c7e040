#include "reports/triage/comparison/rates.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace nearmiss {

double chance_without_rise(const FindingRate& before, const FindingRate& now) {
  if (before.cases == 0 || now.cases == 0 || now.findings == 0) return 1;
  const double sum = double(before.findings) + double(now.findings);
  const double share = double(now.cases) / (double(before.cases) + double(now.cases));
  const boost::math::binomial given_sum(sum, share);
  return cdf(complement(given_sum, double(now.findings) - 1));
}

}  // namespace nearmiss
