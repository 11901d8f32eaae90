// Embeds files in the program.
#pragma once

#include <cstddef>
#include <string_view>

#ifdef _WIN32
#define OCTOBLISK_CONSTANTS ".section .rdata,\"dr\"\n"
#define OCTOBLISK_CODE ".text\n"
#else
#define OCTOBLISK_CONSTANTS ".pushsection .rodata\n"
#define OCTOBLISK_CODE ".popsection\n"
#endif

/// Embeds a file between two C symbols, at file scope. Its path is a string literal.
#define OCTOBLISK_EMBED(symbol, path)      \
  __asm__(OCTOBLISK_CONSTANTS #symbol      \
          "_begin:\n"                      \
          ".incbin \"" path "\"\n" #symbol \
          "_end:\n"                        \
          ".byte 0\n" OCTOBLISK_CODE);     \
  extern "C" const char symbol##_begin[], symbol##_end[]

/// The bytes of an embedded file.
#define OCTOBLISK_EMBEDDED(symbol) \
  std::string_view(symbol##_begin, static_cast<std::size_t>(symbol##_end - symbol##_begin))
