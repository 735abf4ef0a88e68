// Compiled as C++17 and as C++20: supple.hpp takes what either has.
#include <supple/supple.hpp>

#include <array>
#include <vector>
#if __cplusplus >= 202002L
#include <span>
#endif

namespace {

SuppleResult takesWhatCpp17Has(supple::Context& context, supple::Instance& instance, SuppleGroup group) {
    std::vector<float> weights(3);
    const std::vector<float> same = weights;
    const float three[3] = {};
    std::array<float, 16> matrix{};
    const std::array<float, 16> constant{};
    float plain[16] = {};
    SuppleResult results[] = {instance.setMorphWeights(weights),
                              instance.setMorphWeights(same),
                              instance.setMorphWeights(three),
                              instance.setMorphWeights({}),
                              instance.setMorphWeights({weights.data(), 2}),
                              instance.setTransform(matrix),
                              instance.setTransform(constant),
                              instance.setTransform(plain),
                              instance.setTransform(supple::MatrixSpan<const float>(weights.data())),
                              instance.jointTransform(0, matrix),
                              instance.jointTransform(0, plain),
                              context.record(VK_NULL_HANDLE, {&group, 1}, {}, {})};
    return results[0];
}

#if __cplusplus >= 202002L
SuppleResult takesWhatCpp20Has(supple::Instance& instance, std::span<const float> weights,
                               std::span<const float, 16> matrix) {
    const SuppleResult result = instance.setMorphWeights(weights);
    return result == SUPPLE_OK ? instance.setTransform(matrix) : result;
}
#endif

} // namespace

// So that nothing is left out as unused.
SuppleResult suppleHeaderTest(supple::Context& context, supple::Instance& instance, SuppleGroup group);
SuppleResult suppleHeaderTest(supple::Context& context, supple::Instance& instance, SuppleGroup group) {
#if __cplusplus >= 202002L
    const std::array<float, 16> matrix{};
    static_cast<void>(takesWhatCpp20Has(instance, matrix, matrix));
#endif
    return takesWhatCpp17Has(context, instance, group);
}
