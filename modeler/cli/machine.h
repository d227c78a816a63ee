#pragma once

#include <string>

namespace supple {

/// Greatest memory that the program held since it started or forgot [bytes]; 0: not known.
long peak_memory();

/// Gives unused memory back and forgets the peak so far, where the system lets it.
void forget_peak_memory();

/// The processor's name, or "unknown processor".
std::string processor_name();

/// Threads that work at once, for a limit of `limit` (0: none).
int thread_count(int limit);

}  // namespace supple
