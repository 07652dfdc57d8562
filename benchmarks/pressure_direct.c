/* Plain direct sum of the pressure on whole panels, one point a panel: what the hardware can do with it.
 *
 * A panel is wet if its centroid lies below the elevation there. Its pressure head is
 * sum a cos(theta) exp(k (z - zeta)) - z, Wheeler's stretching of linear waves. Panels go in blocks with the
 * components outside, so that the inner loops run over panels and the compiler packs them: build with
 * gcc -O3 -march=native -ffast-math -mprefer-vector-width=512 -shared -fPIC ... -lm, where -ffast-math
 * lets it take the packed cos and exp of the C library (libmvec).
 */
#include <math.h>
#include <stdlib.h>

enum { BLOCK = 64 };

static void rotation(const double *angle, double r[3][3])
{
    const double cr = cos(angle[0]), sr = sin(angle[0]);
    const double cp = cos(angle[1]), sp = sin(angle[1]);
    const double cy = cos(angle[2]), sy = sin(angle[2]);
    const double rows[3][3] = {
        {cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
        {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
        {-sp, cp * sr, cp * cr},
    };
    for (int i = 0; i < 9; i++)
        (&r[0][0])[i] = (&rows[0][0])[i];
}

/* panel: 6 rows of `panels` numbers, centroid and area vector in ship axes [m, m2].
 * wave: 6 rows of `waves` numbers: amplitude, k_x, k_y, k, encounter frequency, phase.
 * pose: 8 numbers each: time, factor on all amplitudes, surge, sway, heave less waterline, roll, pitch, yaw.
 * load: 6 numbers each, force and moment over rho g. Returns 0, or 1 where memory is short. */
int pressure_direct(int panels, const double *panel, int waves, const double *wave, int poses,
                    const double *pose, double *load)
{
    const double *px = panel, *py = px + panels, *pz = py + panels;
    const double *nx = pz + panels, *ny = nx + panels, *nz = ny + panels;
    const double *amplitude = wave, *kx = wave + waves, *ky = kx + waves, *k = ky + waves;
    const double *frequency = k + waves, *lead = frequency + waves;
    double *scratch = malloc((2 + BLOCK) * (size_t)waves * sizeof *scratch);
    double *phase = scratch, *height = scratch + waves, *crests = height + waves;

    if (!scratch)
        return 1;
    for (int b = 0; b < poses; b++, pose += 8, load += 6) {
        double r[3][3];
        double fx = 0, fy = 0, fz = 0, mx = 0, my = 0, mz = 0;
        rotation(pose + 5, r);
        for (int m = 0; m < waves; m++) {
            /* Less than a turn: the packed cos is quick there. */
            phase[m] = fmod(kx[m] * pose[2] + ky[m] * pose[3] - frequency[m] * pose[0] - lead[m], 2 * M_PI);
            height[m] = pose[1] * amplitude[m];
        }
        for (int first = 0; first < panels; first += BLOCK) {
            const int count = panels - first < BLOCK ? panels - first : BLOCK;
            double x[BLOCK], y[BLOCK], z[BLOCK], zeta[BLOCK], depth[BLOCK], head[BLOCK];
            for (int i = 0; i < count; i++) {
                const double cx = px[first + i], cy = py[first + i], cz = pz[first + i];
                x[i] = r[0][0] * cx + r[0][1] * cy + r[0][2] * cz;
                y[i] = r[1][0] * cx + r[1][1] * cy + r[1][2] * cz;
                z[i] = r[2][0] * cx + r[2][1] * cy + r[2][2] * cz + pose[4];
                zeta[i] = 0;
            }
            for (int m = 0; m < waves; m++) {
                double *crest = crests + m * BLOCK;
                for (int i = 0; i < count; i++) {
                    crest[i] = height[m] * cos(kx[m] * x[i] + ky[m] * y[i] + phase[m]);
                    zeta[i] += crest[i];
                }
            }
            for (int i = 0; i < count; i++) {
                depth[i] = fmin(z[i] - zeta[i], 0);
                head[i] = -z[i];
            }
            for (int m = 0; m < waves; m++) {
                const double *crest = crests + m * BLOCK;
                for (int i = 0; i < count; i++)
                    head[i] += crest[i] * exp(k[m] * depth[i]);
            }
            for (int i = 0; i < count; i++) {
                const int j = first + i;
                const double p = depth[i] < 0 ? head[i] : 0;
                fx -= p * nx[j];
                fy -= p * ny[j];
                fz -= p * nz[j];
                mx -= p * (py[j] * nz[j] - pz[j] * ny[j]);
                my -= p * (pz[j] * nx[j] - px[j] * nz[j]);
                mz -= p * (px[j] * ny[j] - py[j] * nx[j]);
            }
        }
        load[0] = fx, load[1] = fy, load[2] = fz, load[3] = mx, load[4] = my, load[5] = mz;
    }
    free(scratch);
    return 0;
}
