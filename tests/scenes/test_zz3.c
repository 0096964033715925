#include "scenes/terrain.h"
#include <stdio.h>
#include <string.h>
typedef struct { double low, high, kick, way, side; } ride;
static fe_geometry form_of(int k){ return k==0?sphere(0.5):k==1?capsule(0.5,0.3):box(0.5,0.25,0.4);}
static double rest_of(int k){ return k==0?0.5:k==1?0.3:0.25;}
static ride go(int ground, int k, double heading, vec start, double speed, int steps)
{
    scene s = scene_begin(NULL);
    fe_material m = friction(k==2?0.1:0.5);
    if (ground == 0) add_ground(&s, m);
    if (ground == 1) add_field(&s, 100, 1.0, -50, -50, level, m);
    if (ground == 2) add_field(&s, 100, 1.0, -100, -50, level, m), add_field(&s, 100, 1.0, 0, -50, level, m);
    if (ground == 3) for (int i = 0; i < 20; ++i) add_static(&s, box(1.25, 0.5, 2), v3(-25+1.25 + 2.5*i, -0.5, 0), UNTURNED, m);
    vec along = v3(cos(heading), 0, sin(heading));
    vec axis = cross(v3(0,1,0), along);
    fe_quat q = turned(v3(0,1,0), -heading);
    if (k == 1) q = compose(q, turned(v3(1,0,0), PI/2));
    fe_body b = add_dynamic(&s, form_of(k), plus(start, v3(0, rest_of(k), 0)), q, m, WATER);
    set_velocity(&s, b, times(speed, along), k == 2 ? v3(0,0,0) : times(speed / rest_of(k), axis));
    ride r = {1e9,-1e9,0,0,0};
    for (int i = 0; i < steps; ++i) {
        run(&s, 1);
        double y = position(&s, b).y - rest_of(k), v = fabs(velocity(&s, b).y);
        if (i > 5) { if (y<r.low) r.low=y; if (y>r.high) r.high=y; if (v>r.kick) r.kick=v; }
    }
    vec d = minus(position(&s, b), start);
    r.way = dot(d, along); r.side = fabs(dot(d, axis));
    scene_end(&s);
    return r;
}
int main(int argc, char **argv)
{
    const char *names[] = {"plane","field","two","boxes"}, *forms[]={"sphere","capsule","box"};
    int g0 = argc>1?atoi(argv[1]):0, g1 = argc>1?g0:3;
    for (int g = g0; g <= g1; ++g) for (int k = 0; k < 3; ++k) {
        int hs = g == 3 || g==0 ? 1 : 16;
        double low=1e9, high=-1e9,kick=0,wmin=1e9,wmax=0,side=0;
        for (int h = 0; h < hs; ++h) {
            double heading = 2*PI*h/16 + (g==3||g==0?0:0.0);
            vec st = g==3? v3(-24,0,0.1): times(-20, v3(cos(heading),0,sin(heading)));
            ride r = go(g,k,heading,st,10, g==3?280:300);
            low=fmin(low,r.low);high=fmax(high,r.high);kick=fmax(kick,r.kick);wmin=fmin(wmin,r.way);wmax=fmax(wmax,r.way);side=fmax(side,r.side);
        }
        printf("%-6s %-8s y %+.5f %+.5f kick %.5f way %.4f %.4f side %.4f\n", names[g],forms[k],low,high,kick,wmin,wmax,side);
    }
}
