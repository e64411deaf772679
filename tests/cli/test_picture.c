/* Pictures of kernels with anti-aliasing: a marked pixel is the mean of its 16 samples, shaded as the
 * pixels of a picture four times as wide and as high are.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "cli/command.h"
#include "cli/picture.h"
#include "kernels/job_msaa.h"

enum { WIDTH = 61, HEIGHT = 43 };

/* A kernel's picture; the run is kept. */
static report_image picture_of(const scene *s, const sim_machine *machine, const char *kernel, unsigned edge, run_result *result)
{
    const kernel_info *info = kernel_find(kernel);
    const run_options options = {.kernel = info, .params = info->defaults, .width = WIDTH * edge, .height = HEIGHT * edge,
                                 .model = RUN_NATIVE, .jobs = 2};
    report_image image = {0};
    base_error err = {0};
    if (run_kernel(s, machine, &options, result, &err) != BASE_OK || picture_shaded(result, &image, &err) != BASE_OK)
        fail_msg("%s: %s", err.what, err.why);
    return image;
}

static void check_mean(const report_image *image, const report_image *large, int x, int y)
{
    for (int channel = 0; channel < 3; channel++) {
        double mean = 0;
        for (int j = 0; j < 16; j++)
            mean += (double)report_image_pixel(large, 4 * x + j % 4, 4 * y + j / 4)[channel] / 16;
        if (fabs(mean - (double)report_image_pixel(image, x, y)[channel]) > 1e-6)
            fail_msg("pixel %d %d, channel %d: %g, mean of the samples %g", x, y, channel, (double)report_image_pixel(image, x, y)[channel], mean);
    }
}

static void picture__marked_pixels__mean_of_their_samples(void **state)
{
    sim_machine *machine = NULL;
    scene *s = NULL;
    command_list none = {0};
    base_error err = {0};
    size_t marked = 0;
    (void)state;
    assert_int_equal(command_machine("larrabee", &none, &machine, &err), BASE_OK);
    assert_int_equal(scene_open("builtin:rooms-804", &s, &err), BASE_OK);
    run_result msaa = {0}, once = {0}, samples = {0};
    report_image image = picture_of(s, machine, "mft-msaa", 1, &msaa), plain = picture_of(s, machine, "mft-primary", 1, &once),
                 large = picture_of(s, machine, "packet16-primary", 4, &samples);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            if (job_msaa_marked(msaa.job, (unsigned)x, (unsigned)y)) {
                check_mean(&image, &large, x, y);
                marked++;
            } else {
                assert_memory_equal(report_image_pixel(&image, x, y), report_image_pixel(&plain, x, y), 3 * sizeof(float));
            }
        }
    assert_in_range(marked, WIDTH, WIDTH * HEIGHT / 2);
    report_image_destroy(&image);
    report_image_destroy(&plain);
    report_image_destroy(&large);
    run_result_destroy(&msaa);
    run_result_destroy(&once);
    run_result_destroy(&samples);
    scene_destroy(&s);
    sim_machine_destroy(&machine);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(picture__marked_pixels__mean_of_their_samples)};
    return cmocka_run_group_tests_name("picture", tests, NULL, NULL);
}
