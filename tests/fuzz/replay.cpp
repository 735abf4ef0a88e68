// A fuzz target without libFuzzer: every file of a corpus, then what the target's mutator makes of them, for some
// seconds. Inputs that take more time or memory than any may are findings as crashes are.
//   replay CORPUS SECONDS MEGABYTES SECONDS_EACH [SEED]
// Time is the process's own, so that a busy machine finds nothing.
#include "tests/fuzz/target.h"
#include "tests/support/host_memory.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

using namespace supple; // NOLINT

namespace {

using Bytes = std::vector<uint8_t>;
using Clock = std::chrono::steady_clock;

double ownSeconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

constexpr size_t kMostBytes = 1u << 16;
fuzz::Random mutationRandom;
uint64_t mostMemory = 0;
double mostSeconds = 0.0;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// The input that is running is kept, for who reads what a crash leaves.
const Bytes* running = nullptr;
std::string kept;

void keep() {
    const int file = open(kept.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && running != nullptr) {
        const ssize_t written = write(file, running->data(), running->size());
        (void)written;
        close(file);
    }
}

void keepAndDie(int number) {
    keep();
    std::signal(number, SIG_DFL);
    std::raise(number);
}

bool runOne(const Bytes& input) {
    running = &input;
    test::resetHostMemory();
    const double begin = ownSeconds();
    LLVMFuzzerTestOneInput(input.data(), input.size());
    const double seconds = ownSeconds() - begin;
    const uint64_t peak = test::hostMemory().peak;
    if (seconds > mostSeconds || peak > mostMemory) {
        keep();
        std::fprintf(stderr, "finding: %.2f s, %.1f MB; the input is %s\n", seconds, static_cast<double>(peak) / 1e6,
                     kept.c_str());
        return false;
    }
    return true;
}

} // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most) {
    const Bytes changed = fuzz::mutateBytes(data, size, mutationRandom);
    const size_t count = std::min(changed.size(), most);
    std::copy_n(changed.begin(), count, data);
    return count;
}

int main(int argc, char** argv) {
    if (argc < 5) {
        std::fprintf(stderr, "usage: %s CORPUS SECONDS MEGABYTES SECONDS_EACH [SEED]\n", argv[0]);
        return 2;
    }
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<Bytes> inputs;
    for (const std::filesystem::path& path : paths) {
        std::ifstream stream(path, std::ios::binary);
        inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    kept = std::string(argv[0]) + ".input";
    for (const int number : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) {
        std::signal(number, keepAndDie);
    }
    const double seconds = std::strtod(argv[2], nullptr);
    mostMemory = std::strtoull(argv[3], nullptr, 10) * 1000000;
    mostSeconds = std::strtod(argv[4], nullptr);
    mutationRandom.seed(argc > 5 ? static_cast<unsigned>(std::strtoul(argv[5], nullptr, 10)) : 1u);
    const Clock::time_point begin = Clock::now();
    uint64_t runs = 0;
    for (const Bytes& input : inputs) {
        ++runs;
        if (!runOne(input)) {
            return 1;
        }
    }
    Bytes input(kMostBytes);
    for (; !inputs.empty() && secondsSince(begin) < seconds; ++runs) {
        const Bytes& from = inputs[mutationRandom() % inputs.size()];
        size_t size = std::min(from.size(), kMostBytes); // longer ones are cut, as libFuzzer does
        input.resize(kMostBytes);
        std::copy_n(from.begin(), size, input.begin());
        for (size_t n = mutationRandom() % 3 + 1; n > 0; --n) {
            size = LLVMFuzzerCustomMutator(input.data(), size, kMostBytes, static_cast<unsigned>(mutationRandom()));
        }
        input.resize(size);
        if (!runOne(input)) {
            return 1;
        }
    }
    std::printf("%llu inputs in %.1f s\n", static_cast<unsigned long long>(runs), secondsSince(begin));
    return runs > 0 ? 0 : 1;
}
