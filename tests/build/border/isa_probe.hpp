// One function, compiled several times for different instruction sets (isa_probe.cpp), in one program (isas.cpp).
#pragma once

#include <shortshot/kernel.hpp>

struct IsaProbe {
  shortshot::Status status;
  const char* message;
  float scsh[shortshot::Scsh336::size];
  float cshot[shortshot::Cshot1344::size];
  unsigned char bits[shortshot::BinaryDescriptor<shortshot::Cshot1344>::size_bytes];
};

IsaProbe describe_sse2();
IsaProbe describe_scalar();
IsaProbe describe_sse2_small();
IsaProbe describe_avx2();
