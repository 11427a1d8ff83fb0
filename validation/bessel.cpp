#include "validation/bessel.h"

#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <limits>

#include "core/contract.h"

namespace grimaldi {
namespace {

// Orders far above the argument overflow: infinity is the answer, not an exception.
using Policy =
    boost::math::policies::policy<boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::underflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::denorm_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::promote_double<false>>;

}  // namespace

double bessel_j(double order, double x) {
  GRIMALDI_EXPECT(order >= 0 && x >= 0);
  return boost::math::cyl_bessel_j(order, x, Policy{});
}

std::complex<double> hankel2(double order, double x) {
  GRIMALDI_EXPECT(order >= 0 && x > 0);
  double y = boost::math::cyl_neumann(order, x, Policy{});
  if (!std::isfinite(y)) y = -std::numeric_limits<double>::infinity();  // whole orders overflow to NaN
  return {boost::math::cyl_bessel_j(order, x, Policy{}), -y};
}

}  // namespace grimaldi
