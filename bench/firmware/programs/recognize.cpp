// Names the objects in views that were linked in, against a model that lies in flash. Prints a hash of all hypotheses,
// which must be the same everywhere, how many views are named rightly, and for the first view a line "section NAME" for
// each counted call; see work.cpp. TASK is what the views are of.
#include "board.hpp"
#include "marks.hpp"
#include "recognition.hpp"

extern "C" {
extern const unsigned char model_begin[], model_end[];
extern const std::uint32_t views_begin[];
}

namespace {

shortshot::ModelView<recognition::Stored> model;
recognition::Memory memory;

struct Count {
  template <class Call>
  void operator()(const char* name, const Call& call) const {
    count_section(name, call);
  }
};

}  // namespace

#define TEXT_OF(word) #word
#define TEXT(word) TEXT_OF(word)

int main() {
  auto opened = shortshot::Status::ok;
  const auto model_bytes = static_cast<std::size_t>(model_end - model_begin);
  Count{}("open", [&] { opened = model.open(model_begin, model_bytes); });
  if (opened != shortshot::Status::ok) {
    board::print(shortshot::message(opened));
    board::print("\n");
    return 1;
  }
  recognition::Task task(model, memory);
  const recognition::Outcome outcome = task.name_all(views_begin, Count{});
  board::print_hash(TEXT(TASK), outcome.hypotheses.value());
  board::print_fact("fact", "views", outcome.views);
  board::print_fact("fact", "right", outcome.right);
  board::print_fact("fact", "keypoints", outcome.keypoints);
  board::print_fact("fact", "codewords", model.codeword_count());
  board::print_fact("fact", "model_bytes", model_bytes);
  board::print_fact("fact", "recognizer_bytes", sizeof memory.recognizer);
  board::print_fact("fact", "objects", model.instance_count());
#if !defined(__unix__)
  board::print_fact("fact", "stack_painted", board::stack_of([&] { task.name_first(views_begin); }));
#endif
  if (outcome.failures > 0) board::print("the memory is too small for a view\n");
  return outcome.failures > 0 ? 1 : 0;
}
