#include "host/operating_system.h"

#include "base/utf8_path.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <io.h>
#include <system_error>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>
// after it
#include <shellapi.h>

namespace supple::host {
namespace {

std::string narrow(const wchar_t* text) {
    const int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
    std::string narrowed(static_cast<size_t>(size > 0 ? size : 1), '\0');
    WideCharToMultiByte(CP_UTF8, 0, text, -1, narrowed.data(), size, nullptr, nullptr);
    narrowed.pop_back();
    return narrowed;
}

std::wstring wide(const std::string& text) {
    const int size = MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, nullptr, 0);
    std::wstring widened(static_cast<size_t>(size > 0 ? size : 1), L'\0');
    MultiByteToWideChar(CP_UTF8, 0, text.c_str(), -1, widened.data(), size);
    widened.pop_back();
    return widened;
}

HANDLE handleOf(std::FILE* stream) {
    return reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(stream)));
}

/// An argument as CommandLineToArgvW takes it apart: backslashes are doubled before a quotation mark alone.
std::wstring quotedArgument(const std::string& argument) {
    std::wstring quoted = L"\"";
    size_t backslashes = 0;
    for (const wchar_t c : wide(argument)) {
        if (c == L'"') {
            quoted.append(backslashes + 1, L'\\');
        }
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        quoted += c;
    }
    return quoted.append(backslashes, L'\\') + L'"';
}

/// A handle that is closed at the end.
class OwnedHandle {
public:
    explicit OwnedHandle(HANDLE handle) : handle_(handle) {}
    ~OwnedHandle() { CloseHandle(handle_); }
    OwnedHandle(const OwnedHandle&) = delete;
    OwnedHandle& operator=(const OwnedHandle&) = delete;
    [[nodiscard]] HANDLE get() const { return handle_; }

private:
    HANDLE handle_;
};

std::wstring variable(const wchar_t* name) {
    const DWORD size = GetEnvironmentVariableW(name, nullptr, 0);
    std::wstring value(size, L'\0');
    value.resize(size > 0 ? GetEnvironmentVariableW(name, value.data(), size) : 0);
    return value;
}

} // namespace

std::vector<std::string> utf8Arguments(int argc, char** argv) {
    int count = 0;
    wchar_t** const wideArguments = CommandLineToArgvW(GetCommandLineW(), &count);
    if (wideArguments == nullptr) {
        return {argv + (argc > 0 ? 1 : 0), argv + argc};
    }
    std::vector<std::string> arguments;
    for (int i = 1; i < count; ++i) {
        arguments.push_back(narrow(wideArguments[i]));
    }
    LocalFree(wideArguments);
    return arguments;
}

StandardStreams::StandardStreams() {
    for (std::FILE* const stream : {stdout, stderr}) {
        std::fflush(stream);
        _setmode(_fileno(stream), _O_BINARY);
    }
    if (isTerminal(stdout) || isTerminal(stderr)) {
        outputState_ = static_cast<long>(GetConsoleOutputCP());
        SetConsoleOutputCP(CP_UTF8);
    }
    DWORD mode = 0;
    if (GetConsoleMode(handleOf(stderr), &mode) != 0) {
        errorState_ = static_cast<long>(mode);
        SetConsoleMode(handleOf(stderr), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
}

StandardStreams::~StandardStreams() {
    if (outputState_ != -1) {
        SetConsoleOutputCP(static_cast<UINT>(outputState_));
    }
    if (errorState_ != -1) {
        SetConsoleMode(handleOf(stderr), static_cast<DWORD>(errorState_));
    }
}

// _isatty calls NUL a terminal as well.
bool isTerminal(std::FILE* stream) {
    DWORD mode = 0;
    return GetConsoleMode(handleOf(stream), &mode) != 0;
}

unsigned long processId() {
    return GetCurrentProcessId();
}

std::string whyNotWritable(const std::filesystem::path& path) {
    return _waccess(path.c_str(), 2) == 0 ? "" : std::strerror(errno);
}

Result<std::string> ownExecutable() {
    std::wstring path(1 << 15, L'\0'); // the longest there is
    const DWORD size = GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    if (size == 0 || size == path.size()) {
        return Error{ErrorCode::asset, "this command does not find its own file"};
    }
    path.resize(size);
    return narrow(path.c_str());
}

Status runCommand(const std::string& command, const std::vector<std::string>& arguments, uint32_t timeout) {
    std::wstring line = quotedArgument(command);
    for (const std::string& argument : arguments) {
        line += L' ' + quotedArgument(argument);
    }
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    const OwnedHandle nowhere(
        CreateFileW(L"NUL", GENERIC_WRITE, FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0, nullptr));
    STARTUPINFOW startup{};
    startup.cb = sizeof startup;
    startup.dwFlags = STARTF_USESTDHANDLES;
    startup.hStdInput = GetStdHandle(STD_INPUT_HANDLE);
    startup.hStdOutput = nowhere.get();
    startup.hStdError = GetStdHandle(STD_ERROR_HANDLE);
    PROCESS_INFORMATION process{};
    if (CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &startup, &process) == 0) {
        return Error{ErrorCode::asset, command + ": cannot be run"};
    }
    CloseHandle(process.hThread);
    const OwnedHandle child(process.hProcess);
    if (WaitForSingleObject(child.get(), timeout < INFINITE / 1000 ? timeout * 1000 : INFINITE) != WAIT_OBJECT_0) {
        TerminateProcess(child.get(), 1);
        WaitForSingleObject(child.get(), INFINITE);
        return Error{ErrorCode::asset,
                     command + ": not done after " + std::to_string(timeout) + " s, the limit, and ended"};
    }
    DWORD code = 0;
    if (GetExitCodeProcess(child.get(), &code) == 0) {
        return Error{ErrorCode::asset, command + ": its end was not seen"};
    }
    if (code != 0) {
        return Error{ErrorCode::asset, command + ": failed with these arguments, exit code " + std::to_string(code)};
    }
    return success();
}

void setEnvironmentDefault(const char* name, const char* value) {
    if (std::getenv(name) == nullptr) {
        _putenv_s(name, value);
    }
}

std::filesystem::path stateFolder() {
    return variable(L"LOCALAPPDATA");
}

std::string cpuName() {
    wchar_t name[256] = {};
    DWORD size = sizeof name;
    const LSTATUS found = RegGetValueW(HKEY_LOCAL_MACHINE, L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0",
                                       L"ProcessorNameString", RRF_RT_REG_SZ, nullptr, name, &size);
    return found == ERROR_SUCCESS ? narrow(name) : "unknown";
}

} // namespace supple::host
