// What learn and recognize do: read, learn or recognize, print and draw.
#pragma once

#include "tools/recognize/options.hpp"

namespace shortshot_bench {

/// Both throw InputError for a model or a cloud that cannot be read, described or written, with its name and, where
/// there is one, the line or byte. A model that cannot be completed stays as it was.
void run_learn(const RecognizeCommand& command);
/// True if the cloud shows an object that was learned.
bool run_recognize(const RecognizeCommand& command);

}  // namespace shortshot_bench
