#include "tests/reports/picture_reader.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace {

// One channel in its own type, so that no conversion hides what the file holds.
template <typename T>
bool read_channel(OIIO::ImageInput &in, OIIO::TypeDesc type, int channel, picture *out)
{
    std::vector<T> data(static_cast<std::size_t>(out->width) * out->height);
    if (!in.read_image(0, 0, channel, channel + 1, type, data.data()))
        return false;
    for (std::size_t i = 0; i < data.size(); i++)
        out->samples[i * out->channels + channel] = static_cast<double>(data[i]);
    return true;
}

bool read_samples(OIIO::ImageInput &in, const OIIO::ImageSpec &spec, picture *out)
{
    for (int c = 0; c < out->channels; c++) {
        OIIO::TypeDesc type = spec.channelformat(c);
        bool ok = type == OIIO::TypeDesc::UINT8    ? read_channel<std::uint8_t>(in, type, c, out)
                  : type == OIIO::TypeDesc::UINT32 ? read_channel<std::uint32_t>(in, type, c, out)
                                                   : read_channel<float>(in, OIIO::TypeDesc::FLOAT, c, out);
        if (!ok)
            return false;
    }
    return true;
}

} // namespace

extern "C" int picture_read(const char *path, picture *out)
{
    *out = picture{};
    auto in = OIIO::ImageInput::open(path);
    if (!in) {
        std::fprintf(stderr, "%s\n", OIIO::geterror().c_str());
        return 0;
    }
    const OIIO::ImageSpec spec = in->spec();
    if (spec.nchannels > 16)
        return 0;
    out->width = spec.width;
    out->height = spec.height;
    out->channels = spec.nchannels;
    for (int c = 0; c < spec.nchannels; c++) {
        std::snprintf(out->names[c], sizeof out->names[c], "%s", spec.channelnames[c].c_str());
        std::snprintf(out->types[c], sizeof out->types[c], "%s", spec.channelformat(c).c_str());
    }
    std::snprintf(out->color_space, sizeof out->color_space, "%s",
                  spec.get_string_attribute("oiio:ColorSpace").c_str());
    std::snprintf(out->date, sizeof out->date, "%s", spec.get_string_attribute("DateTime").c_str());
    std::size_t count = static_cast<std::size_t>(spec.width) * spec.height * spec.nchannels;
    out->samples = static_cast<double *>(std::calloc(count, sizeof(double)));
    if (read_samples(*in, spec, out))
        return 1;
    std::fprintf(stderr, "%s\n", in->geterror().c_str());
    std::free(out->samples);
    return 0;
}

extern "C" int picture_channel(const picture *p, const char *name)
{
    for (int c = 0; c < p->channels; c++)
        if (std::strcmp(p->names[c], name) == 0)
            return c;
    return -1;
}
