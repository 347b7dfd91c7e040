/// The timed batches of a host.
#pragma once

#include "impl/host/serve.hpp"

namespace nearmiss {

/// Times the call for each case of the batch and writes the times in the form of answers, with the stage that gave each
/// answer where the offer tallies its stages: one more call, without a clock, tells it. The calls go through the
/// offer's typed function where it has one. The thread stays on one processor meanwhile, where the system allows it.
/// The rounds end after a quarter of a second. A function that throws breaks every case of the batch.
void time_batch(const OfferedFunctions& offer, const wire::SharedRequest& asked, wire::SharedAnswers& answered);

}  // namespace nearmiss
