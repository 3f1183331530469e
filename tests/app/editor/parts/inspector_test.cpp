#include "app/editor/shell/inspector.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace dollytrack::editor::inspector_test {
namespace {

namespace fs = std::filesystem;

/// A client of the inspector, as the editor tests are.
class Client {
  public:
    explicit Client(const fs::path& path) : socket_(socket(AF_UNIX, SOCK_STREAM, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
        connected_ =
            connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    }
    ~Client() { close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    [[nodiscard]] bool connected() const { return connected_; }
    void ask() const { EXPECT_EQ(send(socket_, "state\n", 6, MSG_NOSIGNAL), 6); }
    [[nodiscard]] std::string line() const {
        std::string text;
        for (char c = 0; read(socket_, &c, 1) == 1 && c != '\n';) text += c;
        return text;
    }

  private:
    int socket_;
    bool connected_ = false;
};

/// Waits, for at most a minute, until a question arrives.
void awaitQuestion(const Inspector& inspector) {
    for (int i = 0; i < 6000 && !inspector.asked(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(inspector.asked());
}

TEST(Inspector, AnswersWithWhatIsShown) {
    const test::TempFolder folder;
    const fs::path path = folder.path() / "s";
    std::atomic<int> woken = 0;
    {
        Inspector inspector(path, [&] { ++woken; });
        const Client client(path);
        ASSERT_TRUE(client.connected());
        client.ask();
        awaitQuestion(inspector);
        inspector.answer({{"open", true}});
        EXPECT_EQ(client.line(), "{\"open\":true}");
    }
    EXPECT_EQ(woken, 1);
    EXPECT_FALSE(fs::exists(path));
}

// --inspect with the path of a scene by mistake must not delete the scene.
TEST(Inspector, LeavesAFileInItsPlaceAlone) {
    const test::TempFolder folder;
    const fs::path path = folder.write("s", "a scene");
    {
        const Inspector inspector(path, [] {});
    }
    std::ifstream file(path);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "a scene");
}

TEST(Inspector, TakesThePlaceOfASocketThatWasLeftBehind) {
    const test::TempFolder folder;
    const fs::path path = folder.path() / "s";
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    const int left_behind = socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(bind(left_behind, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    close(left_behind);
    const Inspector inspector(path, [] {});
    EXPECT_TRUE(Client(path).connected());
}

TEST(Inspector, EndsThoughNobodyReadsItsAnswer) {
    const test::TempFolder folder;
    const fs::path path = folder.path() / "s";
    auto inspector = std::make_unique<Inspector>(path, [] {});
    const Client client(path);
    client.ask();
    awaitQuestion(*inspector);
    inspector->answer(std::string(20'000'000, 'x'));  // more than any socket buffers
    const auto begin = std::chrono::steady_clock::now();
    inspector.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

}  // namespace
}  // namespace dollytrack::editor::inspector_test
