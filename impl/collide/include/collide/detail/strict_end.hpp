// Undoes detail/strict_begin.hpp.

#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#if defined(__clang__) || defined(_MSC_VER)
#pragma float_control(pop)
#elif defined(__GNUC__) && defined(__FP_FAST_FMA)
#pragma GCC pop_options
#endif
