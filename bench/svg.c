// Draws the plots of svg.h, as text: no script, no font of its own, legible on a light and on a dark page.
#include "svg.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    WIDTH = 720,
    MARGIN = 16,
    TITLE = 40,
    BAR = 12,
    GROUP_GAP = 10,
    LABEL = 150,
    VALUE = 60,
    LEGEND = 20,
    IN_LEGEND = 3,
    PLOT = 320,
    AXIS = 60
};

static const double BEYOND = 0.02; // of a decade: a value so little beyond a line of the grid draws no further one

// Told apart with any colour vision (M. Okabe, K. Ito 2008)
static const char *const colours[BENCH_MAX_SERIES] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                      "#d55e00", "#56b4e9", "#777777", "#f0e442"};

static FILE *open_svg(const char *path, int32_t height, const char *title)
{
    FILE *f = fopen(path, "w");
    if (f == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return NULL;
    }
    fprintf(f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
            "font-family=\"sans-serif\" "
            "font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n<text x=\"%d\" y=\"%d\" "
            "font-size=\"15\">%s</text>\n",
            WIDTH, height, WIDTH, height, MARGIN, MARGIN + 10, title);
    return f;
}

static int close_svg(FILE *f)
{
    fprintf(f, "</svg>\n");
    return fclose(f) == 0 ? 0 : -1;
}

static void draw_legend(FILE *f, const bench_series *series, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        const int32_t x = MARGIN + i % IN_LEGEND * ((WIDTH - 2 * MARGIN) / IN_LEGEND),
                      y = TITLE + 8 + i / IN_LEGEND * LEGEND;
        fprintf(f,
                "<rect x=\"%d\" y=\"%d\" width=\"10\" height=\"10\" fill=\"%s\"/><text x=\"%d\" y=\"%d\">%s</text>\n",
                x, y - 9, colours[i], x + 15, y, series[i].name);
    }
}

// where the plot begins
static int32_t below_legend(int32_t count) { return TITLE + (1 + (count - 1) / IN_LEGEND) * LEGEND; }

// ---- bars ----------------------------------------------------------------------------------------------------------

int bench_svg_bars(const char *path, const char *title, const char *const *labels, int32_t label_count,
                   const bench_series *series, int32_t series_count)
{
    const int32_t group = series_count * BAR + GROUP_GAP, top = below_legend(series_count),
                  bottom = top + label_count * group;
    FILE *f = open_svg(path, bottom + MARGIN, title);
    double most = 1.0;
    if (f == NULL) return -1;
    for (int32_t s = 0; s < series_count; s++) {
        for (int32_t i = 0; i < label_count; i++) most = fmax(most, series[s].y[i]);
    }
    const double scale = (WIDTH - 2 * MARGIN - LABEL - VALUE) / most;
    const int32_t left = MARGIN + LABEL;
    draw_legend(f, series, series_count);
    for (int32_t i = 0; i < label_count; i++) {
        const int32_t y = top + i * group;
        fprintf(f, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">%s</text>\n", left - 8, y + series_count * BAR / 2 + 4,
                labels[i]);
        for (int32_t s = 0; s < series_count; s++) {
            const double value = series[s].y[i], length = value * scale;
            if (!(value > 0.0)) continue;
            fprintf(f,
                    "<rect x=\"%d\" y=\"%d\" width=\"%.1f\" height=\"%d\" fill=\"%s\"/><text x=\"%.1f\" y=\"%d\" "
                    "font-size=\"11\">%.3g</text>\n",
                    left, y + s * BAR, length, BAR - 1, colours[s], left + length + 4.0, y + s * BAR + BAR - 2, value);
        }
    }
    fprintf(f, "<line x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\" stroke=\"#000000\" stroke-dasharray=\"3 3\"/>\n",
            left + scale, top - 4, left + scale, bottom);
    return close_svg(f);
}

// ---- lines ---------------------------------------------------------------------------------------------------------

typedef struct axis {
    double low, high; // powers of ten
    double from, to;  // pixels
} axis;

static double place(const axis *a, double value)
{
    return a->from + (a->to - a->from) * (log10(value) - a->low) / (a->high - a->low);
}

static axis axis_of(const bench_series *series, int32_t count, int32_t of_y, double from, double to)
{
    axis a = {HUGE_VAL, -HUGE_VAL, from, to};
    for (int32_t s = 0; s < count; s++) {
        for (int32_t i = 0; i < series[s].count; i++) {
            const double power = log10(of_y ? series[s].y[i] : series[s].x[i]);
            a.low = fmin(a.low, floor(power)), a.high = fmax(a.high, ceil(power - BEYOND));
        }
    }
    if (!(a.high > a.low)) a.high = a.low + 1.0;
    return a;
}

static void draw_grid(FILE *f, const axis *x, const axis *y, const char *x_name, const char *y_name)
{
    for (double p = x->low; p <= x->high; p += 1.0) {
        const double at = place(x, pow(10.0, p));
        fprintf(f,
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#dddddd\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"middle\">%g</text>\n",
                at, y->from, at, y->to, at, y->from + 16.0, pow(10.0, p));
    }
    for (double p = y->low; p <= y->high; p += 1.0) {
        const double at = place(y, pow(10.0, p));
        fprintf(f,
                "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#dddddd\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"end\">%g</text>\n",
                x->from, at, x->to, at, x->from - 6.0, at + 4.0, pow(10.0, p));
    }
    fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", 0.5 * (x->from + x->to),
            y->from + 34.0, x_name);
    fprintf(f, "<text transform=\"translate(%d %.1f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n", MARGIN + 2,
            0.5 * (y->from + y->to), y_name);
}

int bench_svg_lines(const char *path, const char *title, const char *x_name, const char *y_name,
                    const bench_series *series, int32_t series_count)
{
    const int32_t top = below_legend(series_count), bottom = top + PLOT;
    const axis x = axis_of(series, series_count, 0, MARGIN + AXIS, WIDTH - 2 * MARGIN),
               y = axis_of(series, series_count, 1, bottom, top);
    FILE *f = open_svg(path, bottom + AXIS, title);
    if (f == NULL) return -1;
    draw_legend(f, series, series_count);
    draw_grid(f, &x, &y, x_name, y_name);
    for (int32_t s = 0; s < series_count; s++) {
        fprintf(f, "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"%s\" points=\"", colours[s]);
        for (int32_t i = 0; i < series[s].count; i++)
            fprintf(f, "%.1f,%.1f ", place(&x, series[s].x[i]), place(&y, series[s].y[i]));
        fprintf(f, "\"/>\n");
        for (int32_t i = 0; i < series[s].count; i++)
            fprintf(f, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", place(&x, series[s].x[i]),
                    place(&y, series[s].y[i]), colours[s]);
    }
    return close_svg(f);
}

const char *bench_svg_path(const char *path)
{
    static char changed[1024];
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    const int length = dot != NULL && dot > (slash != NULL ? slash : path) ? (int)(dot - path) : (int)strlen(path);
    snprintf(changed, sizeof changed, "%.*s.svg", length, path);
    return changed;
}
