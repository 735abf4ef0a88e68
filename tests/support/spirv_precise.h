// Static check of `precise`: every addition, subtraction, multiplication, division, vector-times-scalar and dot product
// on the way to a stored position must carry NoContraction. glslang's `precise` stops at function boundaries; this does
// not.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace supple::test {

/// Walks back from every variable and parameter of the given OpName (the module must carry names) through stores, calls
/// and struct members to the buffers the values come from. Returns one line an offending instruction: its opcode and
/// function. `checked` counts the arithmetic instructions met. `roots`: square roots are allowed, for what is computed
/// in one place alone.
[[nodiscard]] std::vector<std::string> imprecisePositionArithmetic(std::span<const uint32_t> spirv,
                                                                   const std::string& positionName, uint32_t& checked,
                                                                   bool roots = false);

/// How much arithmetic carries NoContraction in loops to be unrolled. The pass that unrolls them when the library is
/// built forgets it (cmake/supple_shaders.cmake). Adds to `loops` how many such loops there are.
[[nodiscard]] uint32_t preciseInUnrolledLoops(std::span<const uint32_t> spirv, uint32_t& loops);

/// What drivers round as they like, wherever it stands in the module: divisions, remainders, dot products, products of
/// matrices, fused multiply-adds, roots, exponentials, trigonometry. A line each, by their numbers in the
/// specification.
[[nodiscard]] std::vector<std::string> operationsThatDriversRound(std::span<const uint32_t> spirv);

/// A file of SPIR-V.
[[nodiscard]] std::vector<uint32_t> readWords(const std::filesystem::path& path);

/// GLSL below shaders/, compiled with names kept. `strip`: the name of a function whose `precise` qualifiers are
/// removed first, wherever it is defined; "*": everywhere; empty leaves the source alone. `macros`: "-DWIDE", else it
/// is for the narrow mapping. Empty result: it did not compile (the test fails).
[[nodiscard]] std::vector<uint32_t> compileShader(const std::string& path, const std::string& strip,
                                                  const std::string& macros = "");

/// With a piece of the file replaced, which must stand in it once.
[[nodiscard]] std::vector<uint32_t> compileEdited(const std::string& path, const std::string& from,
                                                  const std::string& to, const std::string& macros);

/// As the build does to the library's kernels. Empty: it failed, and so does the test.
[[nodiscard]] std::vector<uint32_t> optimized(const std::vector<uint32_t>& spirv);

} // namespace supple::test
