// An image viewer for tests: listens on the loopback interface and speaks tev's protocol, read from its documentation and
// not from the sender's source.
#pragma once
#include <arpa/inet.h>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace bake::test {

struct ShownPicture {
    std::string name, problem;
    bool to_front = false;
    std::vector<std::string> channels;
    int width = 0, height = 0, updates = 0;
    std::vector<float> values; ///< interleaved, 0 before they come
};

/// Takes one connection, until its other end is closed.
class LoopbackViewer {
public:
    LoopbackViewer() {
        listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in at{};
        at.sin_family = AF_INET, at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof at;
        REQUIRE(bind(listener_, reinterpret_cast<sockaddr*>(&at), size) == 0);
        REQUIRE(listen(listener_, 1) == 0);
        REQUIRE(getsockname(listener_, reinterpret_cast<sockaddr*>(&at), &size) == 0);
        port_ = ntohs(at.sin_port);
        thread_ = std::thread([this] { serve(); });
    }
    ~LoopbackViewer() {
        shutdown(listener_, SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
        close(listener_);
    }
    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
    /// After the sender has ended.
    ShownPicture wait() {
        thread_.join();
        CHECK(shown_.problem == "");
        return std::move(shown_);
    }
    /// As when the viewer is closed while something is sent to it.
    void close_connection() {
        closing_ = true;
        shutdown(listener_, SHUT_RDWR);
    }

private:
    void serve() {
        const int from = accept(listener_, nullptr, nullptr);
        if (from < 0) return;
        timeval brief{0, 100000};
        setsockopt(from, SOL_SOCKET, SO_RCVTIMEO, &brief, sizeof brief);
        std::string bytes;
        char buffer[65536];
        while (!closing_) {
            const ssize_t count = recv(from, buffer, sizeof buffer, 0);
            if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) continue;
            if (count <= 0) break;
            bytes.append(buffer, std::size_t(count));
            take_packets(bytes);
        }
        if (!closing_ && !bytes.empty()) shown_.problem = "the last packet is cut short";
        close(from);
    }

    struct Reader {
        const std::string& bytes;
        std::size_t at = 0;
        template <class T> T get() {
            T value{};
            if (at + sizeof value > bytes.size()) return value;
            std::memcpy(&value, bytes.data() + at, sizeof value);
            at += sizeof value;
            return value;
        }
        std::string text() {
            const std::string word = bytes.c_str() + at;
            at += word.size() + 1;
            return word;
        }
    };

    void take_packets(std::string& bytes) {
        while (bytes.size() >= 4) {
            std::uint32_t length;
            std::memcpy(&length, bytes.data(), 4);
            if (bytes.size() < length) return;
            take(bytes.substr(4, length - 4));
            bytes.erase(0, length);
        }
    }

    void take(const std::string& packet) {
        Reader in{packet};
        const int kind = in.get<std::uint8_t>();
        const bool to_front = in.get<std::uint8_t>() == 1;
        const std::string name = in.text();
        if (kind == 4) {
            shown_.name = name, shown_.to_front = to_front;
            shown_.width = in.get<std::int32_t>(), shown_.height = in.get<std::int32_t>();
            for (int n = in.get<std::int32_t>(); n > 0; --n) shown_.channels.push_back(in.text());
            shown_.values.assign(std::size_t(shown_.width) * shown_.height * shown_.channels.size(), 0.0f);
        } else if (kind == 6) {
            update(in, name);
        } else {
            shown_.problem = "kind " + std::to_string(kind);
        }
        if (in.at != packet.size()) shown_.problem = "length of kind " + std::to_string(kind);
    }

    void update(Reader& in, const std::string& name) {
        if (name != shown_.name) shown_.problem = "name " + name;
        std::vector<std::string> channels;
        for (int n = in.get<std::int32_t>(); n > 0; --n) channels.push_back(in.text());
        if (channels != shown_.channels) shown_.problem = "channels";
        const int x = in.get<std::int32_t>(), y = in.get<std::int32_t>();
        const int width = in.get<std::int32_t>(), height = in.get<std::int32_t>();
        if (x < 0 || y < 0 || x + width > shown_.width || y + height > shown_.height) {
            shown_.problem = "a part outside the picture";
            return;
        }
        std::vector<std::int64_t> places, distances;
        for (std::size_t c = 0; c < channels.size(); ++c) places.push_back(in.get<std::int64_t>());
        for (std::size_t c = 0; c < channels.size(); ++c) distances.push_back(in.get<std::int64_t>());
        const std::size_t start = in.at, pixels = std::size_t(width) * height;
        for (std::size_t p = 0; p < pixels; ++p)
            for (std::size_t c = 0; c < channels.size(); ++c) {
                in.at = start + std::size_t(places[c] + std::int64_t(p) * distances[c]) * sizeof(float);
                const std::size_t pixel = (std::size_t(y) + p / width) * shown_.width + x + p % width;
                shown_.values[pixel * channels.size() + c] = in.get<float>();
            }
        in.at = start + pixels * channels.size() * sizeof(float);
        ++shown_.updates;
    }

    int listener_ = -1, port_ = 0;
    std::atomic<bool> closing_ = false;
    ShownPicture shown_;
    std::thread thread_;
};

} // namespace bake::test
