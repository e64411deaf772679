#include "tests/hard/rays.h"

#include <string.h>

#include "tests/hard/shapes.h"

void rays_with_zeros(base_random *r, unsigned zeros, float d[3])
{
    double direction[3];
    shapes_direction(r, direction);
    for (int k = 0; k < 3; k++)
        if (zeros >> k & 1)
            direction[k] = base_random_bits(r) & 1 ? 0.0 : -0.0;
    shapes_scaled(direction, 2.9, d);
}

void rays_wild(base_random *r, float d[16][3])
{
    for (int j = 0; j < 16; j++) {
        rays_with_zeros(r, base_random_bits(r) % 4 == 0 ? (unsigned)base_random_bits(r) % 7 : 0, d[j]);
        if (j > 0 && base_random_bits(r) % 8 == 0)
            memcpy(d[j], d[j - 1], sizeof d[j]);
    }
}

void rays_grid(base_random *r, double width, int touch, float first[3], float right[3], float down[3])
{
    double f[3], u[3], v[3], spin = base_random_range(r, 0.3, 1.7);
    shapes_direction(r, f);
    shapes_frame(f, u, v);
    for (int k = 0; k < 3; k++) {
        double a = (u[k] * spin + v[k] * 0.3) * width / 16, b = (v[k] * spin - u[k] * 0.2) * width / 16;
        right[k] = (float)a;
        down[k] = (float)b;
        first[k] = (float)(f[k] - 8 * a - 8 * b);
    }
    for (int k = 0; k < 3 && touch; k++)
        if (touch >> k & 1) { /* exactly 0 at the first ray of a block, all along a column or row */
            int n = 4 * (int)(base_random_bits(r) % 4) + (base_random_bits(r) & 1 ? 3 : 0);
            right[k] = base_random_bits(r) & 1 ? 0x1p-6f : -0x1p-6f;
            down[k] = 0.0f;
            first[k] = -(float)n * right[k];
        }
}
