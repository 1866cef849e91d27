// Sends a picture, tile by tile, to an image viewer that listens on a TCP port: tev and others that speak its protocol.
//
// A packet is its length in bytes (this number included), a byte for its kind, a byte that says whether the viewer
// comes to the front, the name of the picture with a zero byte behind it, and
//   kind 4, create   width, height, number of channels, their names, each with a zero byte
//   kind 6, update   number of channels, their names, x, y, width, height of the part, for each channel the place of its first
//                    value, for each channel the distance between values, then the values of the part
// Numbers are little-endian: 32 bits, places and distances 64 bits, values floats.
// https://github.com/Tom94/tev, "IPC".
#pragma once
#include "bake/preview/scene.h"
#include <mutex>
#include <string>
#include <vector>

namespace bake {

struct DisplayAddress {
    std::string host, port;
};
/// "HOST", "HOST:PORT" or "[IPV6]:PORT"; the port is 14158 if it is not given. Throws Error{Refusal::usage}.
DisplayAddress parse_display(const std::string& text);

class Display {
public:
    /// Connects, and creates a picture of `name` with the channels R, G, B. Throws Error{Refusal::unwritable} if nobody
    /// listens there.
    Display(const std::string& address, const std::string& name, int width, int height);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// Sends the values of a part of the picture, 3 per pixel, row by row. From any thread. Does nothing once the
    /// connection is lost: the viewer was closed, or took nothing for five seconds.
    void update(const PixelRect& part, const std::vector<float>& values);
    /// Why the connection was lost; empty while it stands.
    std::string lost() const;

private:
    void send_all(const std::string& packet);

    std::string name_, lost_;
    int socket_ = -1;
    mutable std::mutex mutex_;
};

} // namespace bake
