#include "core/gauss_legendre.h"

#include <cmath>

#include "core/constants.h"
#include "core/contract.h"

namespace grimaldi {

std::vector<GaussPoint> gauss_legendre_points(int n) {
  GRIMALDI_EXPECT(n >= 1);
  std::vector<GaussPoint> points;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    points.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return points;
}

}  // namespace grimaldi
