// The functions that the page's worker calls. The page reads the reply in place.
#include <emscripten.h>

#include <memory>

#include "core.hpp"

// clang-format off
EM_JS(void, gearlash_report, (double share), { Module["report"](share); });
// clang-format on

namespace {

gearlash::web::Core& core() {
  static gearlash::web::Core core({.seconds = [] { return emscripten_get_now() / 1000.0; },
                                   .report = [](double share) { gearlash_report(share); },
                                   .folder = "/tables"});
  return core;
}

gearlash::web::Reply& reply() {
  static gearlash::web::Reply reply;
  return reply;
}

}  // namespace

extern "C" {

/// Answers the request, NUL-terminated UTF-8. The reply stays until the next call.
EMSCRIPTEN_KEEPALIVE void gearlash_ask(const char* request) { reply() = core().ask(request); }
EMSCRIPTEN_KEEPALIVE const char* gearlash_reply() { return reply().json.c_str(); }
EMSCRIPTEN_KEEPALIVE const double* gearlash_numbers() { return reply().numbers.data(); }
EMSCRIPTEN_KEEPALIVE std::size_t gearlash_number_count() { return reply().numbers.size(); }
}
