/// Writes corpus/nyu-ccd/sample.csv. Usage: write_nyu_ccd_sample FILE
#include <cstdio>

#include "corpus/importers/nyu_ccd.hpp"
#include "corpus/storage/codec.hpp"

int main(int argc, char** argv) try {
  if (argc != 2) throw nearmiss::BadInput("write_nyu_ccd_sample: expects one argument, the file to write");
  nearmiss::write_file(argv[1], nearmiss::nyu_ccd_sample());
} catch (const nearmiss::ReportedError& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}
