#include "scenes/terrain.h"
#include <stdio.h>
#include <time.h>
static double wave(double x, double z){ return 0.5*sin(2*PI*0.1*x)*sin(2*PI*0.2*z);} 
static double wave49(double x, double z){ return 0.5*sin(2*PI*0.1*(x))*sin(2*PI*0.2*(z));}
static uint64_t noise=1; static double uni(double a,double b){noise=noise*UINT64_C(6364136223846793005)+UINT64_C(1442695040888963407);return a+(b-a)*(double)(noise>>11)*0x1p-53;}
static double now(void){struct timespec t;clock_gettime(CLOCK_MONOTONIC,&t);return (double)t.tv_sec*1e3+1e-6*(double)t.tv_nsec;}
int main(int argc,char**argv)
{
    int kind = argc>1?atoi(argv[1]):0;
    scene s = scene_begin(NULL);
    if (kind == 3) MUST(fe_world_set_substeps(s.world, 4));
    fe_material m = friction(0.5); m.rolling_resistance = kind==1?0.1f:0.2f; m.spinning_resistance=0.02f;
    if (kind==2) { static float h; (void)h; add_static(&s, box(20,0.5,20), v3(0,-0.5,0), UNTURNED, m);} else
    add_field(&s, 40, 1.0, -20, -20, kind==1?wave49:wave, m);
    static fe_body b[2000]; int n=0;
    if (kind==1) for(int i=0;i<32;++i) for(int j=0;j<32;++j) {
        b[n]=add_dynamic(&s, box(.02,.2,.04), v3(-8+.5*i,5,-8+.5*j), UNTURNED, m, WATER);
        set_velocity(&s,b[n],v3(uni(-1,1),uni(-1,1),uni(-1,1)),v3(uni(-5,5),uni(-5,5),uni(-5,5))); ++n;
    } else for(int i=0;i<500;++i){ double x=uni(-12,12),z=uni(-12,12),y=2+0.02*i;
        fe_geometry g=i%3==0?sphere(0.3):i%3==1?box(.3,.2,.4):capsule(.3,.2);
        b[n++]=add_dynamic(&s,g,v3(x,y,z),turned(v3(uni(-1,1),uni(-1,1),uni(-1,1)),uni(0,3)),m,WATER);
    }
    for(int i=0;i<n;++i) fe_body_set_sleep_allowed(s.world,b[i],1);
    double t0=now(), most=0, coll=0, tot=0;
    for(int i=0;i<900;++i){ double a=now(); run(&s,1); double t=now()-a; if(t>most)most=t; tot+=t;
        fe_profile p={.struct_size=sizeof p}; fe_world_get_profile(s.world,&p); coll+=p.collide;
        int awake=0,below=0; double low=1e9; for(int k=0;k<n;++k){int32_t aw; fe_body_get_awake(s.world,b[k],&aw); awake+=aw; vec q=position(&s,b[k]); double d=q.y-wave(q.x,q.z); if(kind!=2&&fabs(q.x)<20&&fabs(q.z)<20){if(d<0)++below; if(d<low)low=d;}}
        if(i%60==59||!awake){ fe_counters c={.struct_size=sizeof c}; fe_world_get_counters(s.world,&c); printf("%d awake %d below %d low %.3f pairs %d lanes %d\n",i+1,awake,below,low,c.pairs,c.lanes);} if(i==899) for(int k=0;k<n;++k){int32_t aw; fe_body_get_awake(s.world,b[k],&aw); if(aw&&k%1==0){ static int sh; if(sh++<12) {vec v=velocity(&s,b[k]),w=spin(&s,b[k]),q=position(&s,b[k]); printf("k %d kind %d v %.4f w %.4f at %.2f %.2f %.2f\n",k,k%3,length(v),length(w),q.x,q.y,q.z);}}} if(i>=880&&argc>2){int k=atoi(argv[2]); vec q=position(&s,b[k]),v=velocity(&s,b[k]),w=spin(&s,b[k]); printf("%d y %.5f v %.4f %.4f %.4f w %.3f %.3f %.3f\n",i,q.y,v.x,v.y,v.z,w.x,w.y,w.z); fe_contact c[8]; int n2=fe_body_get_contacts(s.world,b[k],c,0,8); for(int j=0;j<n2;++j){ printf("   n %.3f %.3f %.3f dyn %d:",(double)c[j].normal.x,(double)c[j].normal.y,(double)c[j].normal.z,c[j].body_a==b[k]); for(int p2=0;p2<c[j].point_count;++p2){vec r=minus(from_world(&s,c[j].points[p2].point),q);printf(" [%.3f %.3f %.3f s %.5f i %.3f id %x]",r.x,r.y,r.z,(double)c[j].points[p2].separation,(double)c[j].points[p2].total_impulse,c[j].points[p2].id);}printf("\n");}} if(!awake)break;
    }
    printf("total %.1f ms, worst %.2f, collide %.1f (%f)\n", tot, most, coll, now()-t0);
}
