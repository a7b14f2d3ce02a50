#pragma once
/// How long threads that wait at a barrier spin.

namespace diptych::harness {

/// On a shared machine a thread that spins at a barrier takes the processor from the one it waits
/// for: loops became thirty times slower. OpenMP's runtime reads its settings when it is loaded, so
/// the program starts itself once more with a short spin; settings of the user's own are kept.
void limit_spinning(char** argv);

}  // namespace diptych::harness
