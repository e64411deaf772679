// The one place that knows OpenImageIO. Built as a module of its own; see image_writer.h.
#include "reports/image_module.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace {

// A file without a name, in memory: every format can write to it, no disk can be full, and the real file is written
// in one place, by output_file.
class MemoryFile {
public:
    MemoryFile() : fd_(memfd_create("lanetrace-image", MFD_CLOEXEC)) {}
    ~MemoryFile()
    {
        if (fd_ >= 0)
            close(fd_);
    }
    MemoryFile(const MemoryFile &) = delete;
    MemoryFile &operator=(const MemoryFile &) = delete;

    bool ok() const { return fd_ >= 0; }
    std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

    // The contents, for free(); null with errno set on failure.
    unsigned char *take(std::size_t *size) const
    {
        struct stat info;
        if (fstat(fd_, &info) != 0)
            return nullptr;
        std::size_t total = static_cast<std::size_t>(info.st_size);
        auto *bytes = static_cast<unsigned char *>(std::malloc(total ? total : 1));
        for (std::size_t done = 0; bytes && done < total;) {
            ssize_t got = pread(fd_, bytes + done, total - done, static_cast<off_t>(done));
            if (got <= 0) {
                std::free(bytes);
                errno = EIO;
                return nullptr;
            }
            done += static_cast<std::size_t>(got);
        }
        *size = total;
        return bytes;
    }

private:
    int fd_;
};

OIIO::TypeDesc type_of(report_sample sample)
{
    switch (sample) {
    case REPORT_SAMPLE_U8:
        return OIIO::TypeDesc::UINT8;
    case REPORT_SAMPLE_UINT:
        return OIIO::TypeDesc::UINT32;
    case REPORT_SAMPLE_FLOAT:
        break;
    }
    return OIIO::TypeDesc::FLOAT;
}

OIIO::ImageSpec spec_of(const report_image_job &job)
{
    OIIO::ImageSpec spec(job.width, job.height, job.channel_count, type_of(job.channel_samples[0]));
    bool mixed = false;
    spec.channelnames.assign(job.channel_names, job.channel_names + job.channel_count);
    for (int c = 0; c < job.channel_count; c++) {
        spec.channelformats.push_back(type_of(job.channel_samples[c]));
        mixed = mixed || job.channel_samples[c] != job.channel_samples[0];
        if (spec.channelnames[c] == "A")
            spec.alpha_channel = c;
    }
    if (!mixed)
        spec.channelformats.clear();
    // Many writers (exr, tif, dpx, rla) put the present time in unless there is one; png writes only what it is given.
    if (std::string(job.extension) != "png")
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    spec.attribute("Software", "lanetrace");
    spec.attribute("oiio:ColorSpace", job.linear ? "Linear" : "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (std::string(job.extension) == "exr")
        spec.attribute("compression", "zip");
    else if (std::string(job.extension) == "jpg" || std::string(job.extension) == "jpeg")
        spec.attribute("Compression", "jpeg:95");
    return spec;
}

base_status fail_in(base_error *err, const report_image_job &job, const std::string &why)
{
    return base_fail(err, BASE_ERR_INPUT, job.name, "cannot be written as a picture: %s",
                     why.empty() ? "OpenImageIO gives no reason" : why.c_str());
}

// OpenImageIO 2.4 leaves the image name in an SGI header (80 bytes at offset 24) uninitialised.
void clear_sgi_name(unsigned char *bytes, std::size_t size)
{
    if (size >= 104)
        std::memset(bytes + 24, 0, 80);
}

base_status write_to(OIIO::ImageOutput &writer, const std::string &path, const report_image_job &job, base_error *err)
{
    const OIIO::ImageSpec spec = spec_of(job);
    if (!writer.open(path, spec))
        return fail_in(err, job, writer.geterror());
    // Unknown stands for "packed, as channelformats says"; some writers abort on it, so it is kept for mixed types.
    OIIO::TypeDesc type = spec.channelformats.empty() ? spec.format : OIIO::TypeDesc(OIIO::TypeDesc::UNKNOWN);
    if (!writer.write_image(type, job.pixels) || !writer.close())
        return fail_in(err, job, writer.geterror());
    return BASE_OK;
}

base_status encode(const report_image_job &job, unsigned char **bytes, std::size_t *size, base_error *err)
{
    std::unique_ptr<OIIO::ImageOutput> writer = OIIO::ImageOutput::create(job.extension);
    if (!writer) {
        OIIO::geterror(); // an unread error would be printed at exit
        return base_fail(err, BASE_ERR_INPUT, job.name, "OpenImageIO knows no picture format that ends in .%s",
                         job.extension);
    }
    std::string format = writer->format_name();
    if (format == "null" || format == "term")
        return base_fail(err, BASE_ERR_INPUT, job.name, "the format '%s' writes no file", format.c_str());
    // OpenImageIO 2.4 reports success for JPEG 2000 pictures that OpenJPEG refused, and leaves a file without pixels.
    if (format == "jpeg2000")
        return base_fail(err, BASE_ERR_INPUT, job.name, "JPEG 2000 files are not written reliably, so not at all");
    MemoryFile file;
    if (!file.ok())
        return base_fail(err, BASE_ERR_NOMEM, job.name, "no memory for a file: %s", std::strerror(errno));
    base_status status = write_to(*writer, file.path(), job, err);
    if (status != BASE_OK)
        return status;
    *bytes = file.take(size);
    if (!*bytes)
        return base_fail(err, BASE_ERR_NOMEM, job.name, "no memory for the encoded picture");
    if (!*size) {
        std::free(*bytes);
        *bytes = nullptr;
        return fail_in(err, job, "the format wrote nothing");
    }
    if (format == "sgi")
        clear_sgi_name(*bytes, *size);
    return BASE_OK;
}

} // namespace

extern "C" __attribute__((visibility("default"))) base_status lanetrace_image_encode_1(
    const report_image_job *job, unsigned char **bytes, size_t *size, base_error *err)
try {
    *bytes = nullptr;
    *size = 0;
    return encode(*job, bytes, size, err);
} catch (const std::bad_alloc &) {
    return base_fail(err, BASE_ERR_NOMEM, job->name, "out of memory");
} catch (const std::exception &e) {
    return base_fail(err, BASE_ERR_INPUT, job->name, "cannot be written as a picture: %s", e.what());
} catch (...) {
    return base_fail(err, BASE_ERR_INPUT, job->name, "cannot be written as a picture: unknown exception");
}
