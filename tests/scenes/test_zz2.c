#include "scenes/terrain.h"
#include <stdio.h>
static double wave(double x, double z){ return 0.5*sin(2*PI*0.1*x)*sin(2*PI*0.2*z);} 
static uint64_t noise=1; static double uni(double a,double b){noise=noise*UINT64_C(6364136223846793005)+UINT64_C(1442695040888963407);return a+(b-a)*(double)(noise>>11)*0x1p-53;}
int main(int argc,char**argv)
{
    int lost=0, flat=argc>1?atoi(argv[1]):0, shown=0;
    for(int t=0;t<400;++t){
    scene s = scene_begin(NULL);
    fe_material m = friction(0.5); m.rolling_resistance = 0.1f;
    add_field(&s, 40, 1.0, -20, -20, flat?level:wave, m);
    fe_body b=add_dynamic(&s, box(.02,.2,.04), v3(uni(-8,8),5,uni(-8,8)), UNTURNED, m, WATER);
    set_velocity(&s,b,v3(uni(-1,1),uni(-1,1),uni(-1,1)),v3(uni(-5,5),uni(-5,5),uni(-5,5)));
    char log[200][160]; int n=0;
    for(int i=0;i<200;++i){ run(&s,1); vec q=position(&s,b),v=velocity(&s,b),w=spin(&s,b),ax=axis_of(&s,b,v3(0,1,0)); double d=q.y-(flat?0:wave(q.x,q.z));
        fe_contact c[8]; int k=fe_body_get_contacts(s.world,b,c,0,8); double deep=9; int pts=0; double imp=0; for(int j=0;j<k;++j) for(int p=0;p<c[j].point_count;++p){ ++pts; deep=fmin(deep,(double)c[j].points[p].separation); imp+=(double)c[j].points[p].total_impulse;}
        n=i; snprintf(log[i],160,"%d d %.4f v %.2f w %.1f axis.y %.2f patches %d pts %d deepest %.4f imp %.4f ny %.2f",i,d,v.y,length(w),ax.y,k,pts,deep,imp,k?(double)c[0].normal.y:0.);
        if(d<-0.5) break; }
    if(n<199){++lost; if(shown++<2) for(int i=n-14;i<=n;++i) puts(log[i]);}
    scene_end(&s);}
    printf("lost %d of 400\n",lost);
}
