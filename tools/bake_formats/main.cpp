// bake_formats: decodes one picture by OpenImageIO and ends. bake starts it for formats that it does not read itself: a
// decoder that crashes, takes too much memory or does not end on a damaged file takes no more than this process with it.
//
// Descriptor 3 is the open picture, descriptor 4 the pipe for the answer (bake/picture/picture_reply.h).
#include "bake/base/memory.h"
#include "bake/picture/decoder_limits.h"
#include "bake/picture/picture_formats.h"
#include <cstdio>
#include <cstdlib>
#include <new>
#include <unistd.h>

namespace {

constexpr int picture_descriptor = 3, answer_descriptor = 4;

/// Reads the picture within the limits that its file justifies.
void decode_limited(char** arguments, bake::ReplyStream& reply) {
    const bake::PictureFile file(picture_descriptor, arguments[2]);
    const bake::ReadLimits limits{.max_bytes = std::atoll(arguments[3]), .reason = arguments[7]};
    const bake::DecodeRequest request{.format = arguments[1],
                                      .limits = limits,
                                      .texels = std::string(arguments[4]) == "texels",
                                      .samples = std::atof(arguments[5]),
                                      .largest =
                                          bake::decoder_limits(file.size(), double(limits.max_bytes) / sizeof(float)),
                                      .libraries = std::int64_t(bake::process_memory().address_space)};
    bake::limit_decoder(bake::decoder_limits(file.size(), request.samples), request.largest, request.libraries);
    decode(file, request, reply);
}

void answer(char** arguments, bake::ReplyStream& reply) {
    const std::string path = arguments[2];
    const auto fail = [&](const bake::Error& error) {
        reply.send(bake::ReplyFrame::failure, bake::to_bytes(bake::ReplyFailure{error.refusal, error.what()}));
    };
    try {
        decode_limited(arguments, reply);
    } catch (const bake::Error& error) {
        fail(error);
    } catch (const std::bad_alloc&) {
        fail(bake::decoder_failed(path, "took too much memory"));
    } catch (const std::exception& error) { // some decoders pass on what their containers throw
        fail(bake::decoder_failed(path, std::string("gave up (") + error.what() + ")"));
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 8) {
        std::fputs("bake_formats is started by bake, which reads pictures by it; run bake check FILE\n", stderr);
        return 2;
    }
    // Without bake there is nobody to read the answer, nor to end this process.
    bake::end_with(pid_t(std::atoll(argv[6])));
    bake::ReplyStream reply(answer_descriptor);
    reply.send(bake::ReplyFrame::started); // until here, the picture cannot be at fault
    answer(argv, reply);
    _exit(0); // the libraries take longer to end than to decode a small picture
}
