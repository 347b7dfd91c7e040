/// Compiles and links only where collide::certified brings the headers and libraries of GMP and MPFR.
#include <gmp.h>
#include <mpfr.h>

#include <collide/closest_point_segment.hpp>
#if __has_include(<collide/certified.hpp>)
#include <collide/certified.hpp>
#endif

int main() {
  mpq_t third;
  mpq_init(third);
  mpq_set_ui(third, 1, 3);
  mpfr_t rounded;
  mpfr_init2(rounded, 53);
  mpfr_set_q(rounded, third, MPFR_RNDN);
  const bool right = mpfr_get_d(rounded, MPFR_RNDN) == 1.0 / 3;
  mpfr_clear(rounded);
  mpq_clear(third);
  return right ? 0 : 1;
}
