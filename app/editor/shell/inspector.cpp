#include "app/editor/shell/inspector.h"

#include "engine/core/log.h"

#include <nlohmann/json.hpp>

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

namespace dollytrack::editor {

namespace {

constexpr timeval kSendTimeout{2, 0};

}  // namespace

struct Inspector::Impl {
    std::filesystem::path path;
    std::function<void()> wake;
    int listener = -1;
    mutable std::mutex mutex;
    std::condition_variable answered;
    bool asked = false;
    bool stopping = false;
    std::string answer;
    std::thread thread;
    bool listens = false;

    bool waitReadable(int socket) const;
    void serve(int client);
    void loop();
};

bool Inspector::Impl::waitReadable(int socket) const {
    while (true) {
        {
            const std::lock_guard lock(mutex);
            if (stopping) return false;
        }
        pollfd wanted{socket, POLLIN, 0};
        if (poll(&wanted, 1, 50) > 0) return true;
    }
}

void Inspector::Impl::serve(int client) {
    std::string received;
    std::array<char, 256> buffer{};
    while (waitReadable(client)) {
        const ssize_t count = read(client, buffer.data(), buffer.size());
        if (count <= 0) return;
        received.append(buffer.data(), static_cast<std::size_t>(count));
        for (std::size_t end = 0; (end = received.find('\n')) != std::string::npos;) {
            received.erase(0, end + 1);
            std::unique_lock lock(mutex);
            asked = true;
            answer.clear();
            wake();
            answered.wait(lock, [this] { return stopping || !answer.empty(); });
            if (stopping) return;
            const std::string reply = answer + "\n";
            lock.unlock();
            std::size_t sent = 0;
            while (sent < reply.size()) {
                const ssize_t n =
                    send(client, reply.data() + sent, reply.size() - sent, MSG_NOSIGNAL);
                if (n <= 0) return;
                sent += static_cast<std::size_t>(n);
            }
        }
    }
}

void Inspector::Impl::loop() {
    while (waitReadable(listener)) {
        const int client = accept(listener, nullptr, nullptr);
        if (client < 0) continue;
        // A client that does not read must not keep the editor from ending.
        setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &kSendTimeout, sizeof(kSendTimeout));
        serve(client);
        close(client);
    }
}

Inspector::Inspector(const std::filesystem::path& socket_path, std::function<void()> wake)
    : impl_(std::make_unique<Impl>()) {
    impl_->path = socket_path;
    impl_->wake = std::move(wake);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = socket_path.string();
    if (name.size() >= sizeof(address.sun_path)) {
        log::error("editor", "the name of the inspection socket is too long: " + name);
        return;
    }
    std::memcpy(address.sun_path, name.c_str(), name.size() + 1);
    // Replaces only a socket left by an earlier editor, never another file.
    struct stat there {};
    if (lstat(name.c_str(), &there) == 0 &&
        (!S_ISSOCK(there.st_mode) || unlink(name.c_str()) != 0)) {
        log::error("editor", "cannot listen on " + name + ": a file of that name exists");
        return;
    }
    impl_->listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (impl_->listener < 0 ||
        bind(impl_->listener, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
        listen(impl_->listener, 4) != 0) {
        log::error("editor", "cannot listen on " + name + ": " + std::strerror(errno));
        return;
    }
    impl_->listens = true;
    impl_->thread = std::thread([this] { impl_->loop(); });
}

Inspector::~Inspector() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stopping = true;
    }
    impl_->answered.notify_all();
    if (impl_->thread.joinable()) impl_->thread.join();
    if (impl_->listener >= 0) close(impl_->listener);
    if (impl_->listens) unlink(impl_->path.c_str());
}

bool Inspector::asked() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->asked;
}

void Inspector::answer(const nlohmann::json& state) {
    const std::lock_guard lock(impl_->mutex);
    impl_->asked = false;
    impl_->answer = state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    impl_->answered.notify_all();
}

}  // namespace dollytrack::editor
