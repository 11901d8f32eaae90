// Stops compilation with a clear message if the compiler's language standard is older than C++20.
#pragma once

#if !defined(_MSVC_LANG) && __cplusplus < 202002L || defined(_MSVC_LANG) && _MSVC_LANG < 202002L
#error \
    "OctoBlisk needs C++20: compile with -std=c++20, or link the CMake target OctoBlisk::bullet or OctoBlisk::core"
#endif
