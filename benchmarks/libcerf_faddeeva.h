#pragma once
// The opponent of our Faddeeva function.

#include <complex>

namespace grimaldi {

/// w_of_z of libcerf.
std::complex<double> libcerf_faddeeva(std::complex<double> z);

}  // namespace grimaldi
