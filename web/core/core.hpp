// The numerical core of the page: requests and replies in JSON.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gearlash::web {

/// What the core needs of its surroundings.
struct Host {
  std::function<double()> seconds;  ///< a clock that only rises
  /// Takes the share of the work that is done, 0 … 1.
  std::function<void(double share)> report = [](double) {};
  std::string folder{};  ///< of the tables that drives name
};

/// Columns of numbers stand beside the JSON, which refers to them as {"at": index, "count": n}.
struct Reply {
  std::string json;
  std::vector<double> numbers;
};

/// Answers the page's requests, in the words of web/page/replies.ts. One object serves one page. It
/// keeps the last drive and its answer, from which the next one is followed.
class Core {
 public:
  explicit Core(Host host);
  ~Core();
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  /// `request`: {"ask": "answer", …}. A reply has "faults", each with path, value, permitted and
  /// where, if the input was bad, or "failure" with a sentence if the work could not be done. Never
  /// throws, except std::bad_alloc.
  Reply ask(std::string_view request);

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace gearlash::web
