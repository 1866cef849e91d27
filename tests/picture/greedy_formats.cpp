// In the place of OpenImageIO in a bake_formats of its own: does what damaged files make decoders do. The file says in its
// last line what that is.
#include "bake/picture/picture_formats.h"
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

namespace bake {
namespace {

/// Two grey texels.
ReplyHeader header_of(int width = 2) {
    ReplyHeader header;
    header.info.format = "pnm", header.info.channels = {"Y"}, header.info.colours = 1;
    header.info.type = SampleType::u8, header.info.bits = 8;
    header.data = header.picture = {0, 0, width, 1};
    header.sent = SampleType::u8;
    return header;
}

void send_picture(ReplyStream& reply, const ReplyHeader& header, const std::string& texels) {
    reply.send(ReplyFrame::header, to_bytes(header));
    reply.send(ReplyFrame::texels, texels);
    reply.send(ReplyFrame::end);
}

/// Neither an open descriptor nor a signal of the program that started this one is left.
bool inherits_nothing() {
    for (int descriptor = 5; descriptor < 1024; ++descriptor)
        if (fcntl(descriptor, F_GETFD) >= 0) return false;
    for (const int signal : {SIGPIPE, SIGXFSZ, SIGUSR1}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler != SIG_DFL) return false;
    }
    return !isatty(0) && !isatty(1) && !isatty(2);
}

/// Uses memory that was asked for without a look at whether it was granted, as libraries in C do.
void crash_without_memory() {
    for (;;) {
        volatile char* const memory = static_cast<volatile char*>(std::malloc(std::size_t(1) << 28));
        *memory = 1;
    }
}

} // namespace

void decode(const PictureFile& file, const DecodeRequest&, ReplyStream& reply) {
    std::string act = file.head();
    act = act.substr(act.rfind('\n') + 1);
    ReplyHeader header = header_of();
    if (act == "crash") std::raise(SIGSEGV);
    if (act == "abort") std::abort();
    if (act == "exit") _exit(0);
    if (act == "sleep") pause();
    if (act == "memory") send_picture(reply, header, std::string(std::size_t(1) << 29, 'x'));
    if (act == "careless") crash_without_memory();
    if (act == "time")
        for (volatile unsigned turns = 0;;) turns = turns + 1;
    if (act == "throw") throw std::length_error("vector::_M_default_append");
    if (act == "foreign")
        reply.send(ReplyFrame::failure, to_bytes(ReplyFailure{Refusal::unreadable, "/etc/passwd: no"}));
    if (act == "wide") header = header_of(1 << 20);
    if (act == "alpha") header.info.alpha_channel = 7;
    if (act == "bytes") reply.send(ReplyFrame::header, std::string(100, '\xff'));
    if (act == "kind") reply.send(ReplyFrame::Kind(9));
    if (act == "twice") reply.send(ReplyFrame::header, to_bytes(header));
    if (act == "inherit" && !inherits_nothing()) std::abort();
    send_picture(reply, header, std::string("\x00\xff\x80", act == "more" ? 3 : act == "fewer" ? 1 : 2));
}

} // namespace bake
