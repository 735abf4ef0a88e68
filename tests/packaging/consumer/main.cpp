// The same in C++17, without exceptions and run-time types.
#include <cstdio>
#include <cstring>
#include <supple/supple.hpp>

int main() {
    SuppleContext context = nullptr;
    if (std::strlen(suppleResultString(SUPPLE_OK)) == 0) {
        return 1;
    }
    if (suppleCreateContext(nullptr, &context) != SUPPLE_ERROR_ARGUMENT || context != nullptr) {
        return 2;
    }
    std::printf("C++ %d.%d.%d %s\n", SUPPLE_VERSION_MAJOR, SUPPLE_VERSION_MINOR, SUPPLE_VERSION_PATCH,
                suppleResultString(SUPPLE_ERROR_ARGUMENT));
    return 0;
}
