#pragma once

/// Marks what the solver library shows to its users; everything else in it is hidden.
#define SUPPLE_API __attribute__((visibility("default")))
