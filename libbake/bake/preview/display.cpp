#include "bake/preview/display.h"
#include "bake/base/error.h"
#include <bit>
#include <cerrno>
#include <cstring>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace bake {
namespace {

static_assert(std::endian::native == std::endian::little);

enum class Kind : std::uint8_t { create = 4, update = 6 };

/// A packet without its length.
class Packet {
public:
    Packet(Kind kind, bool to_front, const std::string& name) {
        bytes_.push_back(char(kind));
        bytes_.push_back(char(to_front));
        add(name);
    }
    void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
    template <class Number> void add(const Number* numbers, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
    }
    void add(std::int32_t number) { add(&number, 1); }

    std::string with_length() const {
        const auto length = std::uint32_t(bytes_.size() + sizeof(std::uint32_t));
        return std::string(reinterpret_cast<const char*>(&length), sizeof length) + bytes_;
    }

private:
    std::string bytes_;
};

const std::string channels[] = {"R", "G", "B"};

/// A connected socket, or -1 and errno.
int connect_to(const addrinfo* addresses) {
    // A viewer that stands still must not hold up the rendering for ever.
    const timeval patience{5, 0};
    int reason = ECONNREFUSED;
    for (const addrinfo* at = addresses; at; at = at->ai_next) {
        const int made = socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC, at->ai_protocol);
        if (made >= 0) {
            setsockopt(made, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
            if (connect(made, at->ai_addr, at->ai_addrlen) == 0) return made;
        }
        reason = errno;
        if (made >= 0) close(made);
    }
    errno = reason;
    return -1;
}

} // namespace

DisplayAddress parse_display(const std::string& text) {
    const Error wrong(Refusal::usage,
                      "`display` " + text + ": is not an address; write HOST:PORT, such as localhost:14158");
    DisplayAddress address{text, "14158"};
    std::size_t colon = text.rfind(':');
    const bool bracketed = text.starts_with("[");
    if (bracketed) {
        const std::size_t close = text.find(']');
        if (close == std::string::npos) throw wrong;
        address.host = text.substr(1, close - 1);
        if (close + 1 < text.size() && text[close + 1] != ':') throw wrong;
        colon = close + 1 < text.size() ? close + 1 : std::string::npos;
    } else if (colon != std::string::npos) {
        if (text.find(':') != colon) throw wrong; // an IPv6 address without brackets
        address.host = text.substr(0, colon);
    }
    if (colon != std::string::npos) address.port = text.substr(colon + 1);
    const bool digits = !address.port.empty() && address.port.size() <= 5 &&
                        address.port.find_first_not_of("0123456789") == std::string::npos;
    if (address.host.empty() || !digits || std::stoi(address.port) < 1 || std::stoi(address.port) > 65535) throw wrong;
    return address;
}

Display::Display(const std::string& address, const std::string& name, int width, int height) : name_(name) {
    const DisplayAddress to = parse_display(address);
    const auto refuse = [&](const std::string& reason) {
        return Error(Refusal::unwritable,
                     address + ": cannot be reached (" + reason + "); start the viewer first, or remove `display`");
    };
    addrinfo hints{}, *addresses = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    if (const int failed = getaddrinfo(to.host.c_str(), to.port.c_str(), &hints, &addresses); failed != 0)
        throw refuse(failed == EAI_SYSTEM ? std::strerror(errno) : gai_strerror(failed));
    socket_ = connect_to(addresses);
    const int reason = errno;
    freeaddrinfo(addresses);
    if (socket_ < 0) throw refuse(std::strerror(reason));
    Packet packet(Kind::create, true, name);
    for (const int number : {width, height, int(std::size(channels))}) packet.add(number);
    for (const std::string& channel : channels) packet.add(channel);
    send_all(packet.with_length());
}

Display::~Display() {
    if (socket_ >= 0) close(socket_);
}

void Display::update(const PixelRect& part, const std::vector<float>& values) {
    const std::lock_guard lock(mutex_);
    if (!lost_.empty()) return;
    constexpr std::int64_t places[] = {0, 1, 2}, distances[] = {3, 3, 3};
    Packet packet(Kind::update, false, name_);
    packet.add(int(std::size(channels)));
    for (const std::string& channel : channels) packet.add(channel);
    for (const int number : {part.x, part.y, part.width, part.height}) packet.add(number);
    packet.add(places, std::size(places));
    packet.add(distances, std::size(distances));
    packet.add(values.data(), values.size());
    send_all(packet.with_length());
}

std::string Display::lost() const {
    const std::lock_guard lock(mutex_);
    return lost_;
}

void Display::send_all(const std::string& packet) {
    for (std::size_t sent = 0; sent < packet.size();) {
        const ssize_t count = send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            lost_ = errno == EAGAIN || errno == EWOULDBLOCK ? "it takes nothing" : std::strerror(errno);
            return;
        }
        sent += std::size_t(count);
    }
}

} // namespace bake
