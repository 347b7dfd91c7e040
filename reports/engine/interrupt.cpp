#include "reports/engine/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace nearmiss {

namespace {
volatile std::sig_atomic_t requested = 0;
}

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { requested = 1; };
  action.sa_flags = int(SA_RESETHAND);
  for (const int s : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (s == SIGHUP && sigaction(s, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(s, &action, nullptr);
  }
}

bool interrupted() { return requested != 0; }

}  // namespace nearmiss
