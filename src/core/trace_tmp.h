#pragma once
#include <chrono>
#include <cstdio>
#include <mutex>
namespace candela { inline std::chrono::steady_clock::time_point g_t0; 
inline void tr(const char* w){ std::fprintf(stderr,"TR %8.2f %s\n", std::chrono::duration<double,std::milli>(std::chrono::steady_clock::now()-g_t0).count(), w);} }
