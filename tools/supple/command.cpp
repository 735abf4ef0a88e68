#include "tools/supple/command.h"

#include "cage/message.h"
#include "tools/supple/progress.h"

#include <algorithm>
#include <cstdio>

namespace supple::tools {

std::string printable(std::string_view text) {
    return cage::oneLine(text, ' ');
}

int fail(ExitCode code, std::string_view reason) {
    for (size_t begin = 0; begin <= reason.size();) {
        const size_t end = std::min(reason.find('\n', begin), reason.size());
        std::fprintf(stderr, "%ssupple: %s\n", std::string(lineBegin()).c_str(),
                     printable(reason.substr(begin, end - begin)).c_str());
        begin = end + 1;
    }
    return code;
}

int fail(const Error& error) {
    return fail(error.code == ErrorCode::unsupported ? kExitNoDevice : kExitBadInput, error.message);
}

void note(std::string_view text) {
    std::printf("supple: %s\n", printable(text).c_str());
    std::fflush(stdout);
}

void warn(std::string_view text) {
    std::fprintf(stderr, "%ssupple: warning: %s\n", std::string(lineBegin()).c_str(), printable(text).c_str());
}

} // namespace supple::tools
