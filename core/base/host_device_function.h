#pragma once
/// Marks functions that kernels call, wherever they run. With core/compute/host_device.h the only
/// header that asks which compiler reads it.

#if defined(__CUDACC__)
#define HEWN_HD __host__ __device__ __forceinline__
#else
#define HEWN_HD inline __attribute__((always_inline))
#endif
