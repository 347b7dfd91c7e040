/// The reason of a broken program is the line with the error, whatever its runtime writes around it.
#include "impl/host/error_line.hpp"

#include <gtest/gtest.h>

namespace nearmiss {
namespace {

struct Output {
  const char *of, *text, *error;
};

const Output outputs[] = {
    {"nothing", "", ""},
    {"blank_lines", "\n \n", ""},
    {"a_message", "start\nbad radius\n\n", "bad radius"},
    {"an_indented_message", "start\n  bad radius\n", "bad radius"},
    {"a_log_and_a_message", "Error: no license, going on\nbad radius\n", "bad radius"},
    {"node",
     "/lib/balls.js:1\nfunction f(){ throw new TypeError(\"boom\"); }\n              ^\n\nTypeError: boom\n"
     "    at f (/lib/balls.js:1:21)\n    at Module._compile (node:internal/modules/cjs/loader:1521:14)\n\nNode.js "
     "v20.20.2\n",
     "TypeError: boom"},
    {"node_with_members",
     "node:fs:573\n  return binding.open(\n                 ^\n\nError: ENOENT: no such file or directory, open "
     "'/nope'\n"
     "    at Object.openSync (node:fs:573:18) {\n  errno: -2,\n  code: 'ENOENT'\n}\n\nNode.js v20.20.2\n",
     "Error: ENOENT: no such file or directory, open '/nope'"},
    {"node_with_an_error_of_ones_own", "x.js:1\n^\n\nBadRadius: -1\n    at f (x.js:1:2)\n\nNode.js v20.20.2\n",
     "BadRadius: -1"},
    {"node_that_throws_a_text",
     "[eval]:1\nthrow \"text\"\n^\ntext\n(Use `node --trace-uncaught ...` to show where the exception was "
     "thrown)\n\nNode.js v20.20.2\n",
     "text"},
    {"node_with_a_rejected_promise",
     "node:internal/process/promises:389\n      new UnhandledPromiseRejection(reason);\n      ^\n\n"
     "UnhandledPromiseRejection: This error originated either by throwing inside of an async function without a catch\n"
     "    at throwUnhandledRejectionsMode (node:internal/process/promises:389:7) {\n  code: "
     "'ERR_UNHANDLED_REJECTION'\n}\n\nNode.js v20.20.2\n",
     "UnhandledPromiseRejection: This error originated either by throwing inside of an async function without a catch"},
    {"python", "Traceback (most recent call last):\n  File \"<string>\", line 3, in <module>\nValueError: no\n",
     "ValueError: no"},
    {"python_with_a_cause",
     "Traceback (most recent call last):\n  File \"a.py\", line 3\nKeyError: 1\n\nDuring handling of the above "
     "exception, another "
     "exception occurred:\n\nTraceback (most recent call last):\n  File \"a.py\", line 5\nballs.Wrong: radius\n",
     "balls.Wrong: radius"},
    {"python_killed",
     "Fatal Python error: Segmentation fault\n\nCurrent thread 0x00007f (most recent call first):\n  File \"a.py\", "
     "line 3 in f\n\n"
     "Extension modules: numpy.core (total: 1)\n",
     "Fatal Python error: Segmentation fault"},
    {"cpp", "terminate called after throwing an instance of 'std::runtime_error'\n  what():  bad radius\n",
     "what():  bad radius"},
    {"cpp_without_text", "terminate called after throwing an instance of 'int'\n",
     "terminate called after throwing an instance of 'int'"},
    {"cpp_in_a_shell",
     "terminate called after throwing an instance of 'std::runtime_error'\n  what():  bad radius\nAborted (core "
     "dumped)\n",
     "what():  bad radius"},
    {"assertion", "balls: balls.c:42: balls_meet: Assertion `radius > 0' failed.\n",
     "balls: balls.c:42: balls_meet: Assertion `radius > 0' failed."},
    {"address_sanitizer",
     "=================================================================\n==7==ERROR: AddressSanitizer: "
     "heap-buffer-overflow on "
     "address 0x60 at pc 0x55\nWRITE of size 4 at 0x60 thread T0\n    #0 0x55 in main /tmp/a.cpp:2\n\nSUMMARY: "
     "AddressSanitizer: "
     "heap-buffer-overflow /tmp/a.cpp:2 in main\nShadow bytes around the buggy address:\n  0x0c: 00 00\n=>0x0d: fa "
     "fa[04]\nShadow byte legend (one shadow byte represents 8 application bytes):\n  Addressable:           "
     "00\n==7==ABORTING\n",
     "SUMMARY: AddressSanitizer: heap-buffer-overflow /tmp/a.cpp:2 in main"},
    {"undefined_behaviour_sanitizer",
     "u.cpp:1:44: runtime error: signed integer overflow\n    #0 0x55 in main u.cpp:1\n\nSUMMARY: "
     "UndefinedBehaviorSanitizer: "
     "undefined-behavior u.cpp:1:44 in \n",
     "u.cpp:1:44: runtime error: signed integer overflow"},
    {"rust",
     "\nthread 'main' (4508) panicked at p.rs:1:12:\nassertion `left == right` failed: radius 3\n  left: 1\n right: "
     "2\nstack "
     "backtrace:\n   0: __rustc::rust_begin_unwind\n             at /rustc/library/std/src/panicking.rs:689:5\nnote: "
     "Some details "
     "are omitted, run with `RUST_BACKTRACE=full` for a verbose backtrace.\n",
     "thread 'main' (4508) panicked at p.rs:1:12: assertion `left == right` failed: radius 3"},
    {"old_rust",
     "thread 'main' panicked at 'bad radius', src/main.rs:2:5\nnote: run with `RUST_BACKTRACE=1` environment variable "
     "to display "
     "a backtrace\n",
     "thread 'main' panicked at 'bad radius', src/main.rs:2:5"},
    {"java",
     "Exception in thread \"main\" java.lang.RuntimeException: outer\n\tat J.main(J.java:1)\nCaused by: "
     "java.lang.IllegalStateException: inner\n\tat J.main(J.java:1)\n\t... 3 more\n",
     "Exception in thread \"main\" java.lang.RuntimeException: outer"},
    {"java_machine",
     "#\n# A fatal error has been detected by the Java Runtime Environment:\n#\n#  SIGSEGV (0xb) at pc=0x00007f, "
     "pid=7, tid=8\n#\n# "
     "JRE version: OpenJDK Runtime Environment\n# An error report file with more information is saved as:\n# "
     "/x/hs_err_pid7.log\n#\n",
     "SIGSEGV (0xb) at pc=0x00007f, pid=7, tid=8"},
    {"go",
     "panic: runtime error: index out of range [5] with length 3\n\ngoroutine 1 "
     "[running]:\nmain.main()\n\t/x/main.go:5 +0x1d\nexit "
     "status 2\n",
     "panic: runtime error: index out of range [5] with length 3"},
    {"ruby", "a.rb:1:in `f': bad radius (RuntimeError)\n\tfrom a.rb:2:in `<main>'\n",
     "a.rb:1:in `f': bad radius (RuntimeError)"},
};

void PrintTo(const Output& o, std::ostream* out) { *out << o.of; }

class ErrorLine : public testing::TestWithParam<Output> {};

TEST_P(ErrorLine, IsTheOneWithTheError) { EXPECT_EQ(error_line_of(GetParam().text), GetParam().error); }

INSTANTIATE_TEST_SUITE_P(Of, ErrorLine, testing::ValuesIn(outputs),
                         [](const auto& of) { return std::string(of.param.of); });

}  // namespace
}  // namespace nearmiss
