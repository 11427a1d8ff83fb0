#include "benchmarks/libcerf_faddeeva.h"

namespace {

// C's complex number, which C++ knows as an extension only; the library's own header needs C.
__extension__ using CComplex = double _Complex;

}  // namespace

extern "C" CComplex w_of_z(CComplex z);

namespace grimaldi {

std::complex<double> libcerf_faddeeva(std::complex<double> z) {
  CComplex argument;
  __real__ argument = z.real();
  __imag__ argument = z.imag();
  const CComplex w = w_of_z(argument);
  return {__real__ w, __imag__ w};
}

}  // namespace grimaldi
