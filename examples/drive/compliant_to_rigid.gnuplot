# Draws what compliant_to_rigid prints: gnuplot -c compliant_to_rigid.gnuplot FILE.svg
set terminal svg size 720,480 font 'sans,13' background rgb 'white'
set encoding utf8
set output ARG1
set title "Compliant contact tends to rigid contact"
set xlabel "stiffness of the mesh, by that of the loop"
set ylabel "amplitude of the cycle, from that of rigid faces"
set logscale xy
set format '10^{%T}'
set grid linewidth 0.5 linecolor rgb '#c4c4c4'
set tics nomirror out
set key top right
set xrange [50:2e6]
plot '< compliant_to_rigid' using 1:3 with linespoints linewidth 1.8 pointtype 7 \
       linecolor rgb '#0072b2' title 'damping 0.1 of stiffness, to restitution 0', \
     0.35/x with lines dashtype 3 linecolor rgb '#0072b2' title '1/stiffness', \
     '< compliant_to_rigid' using 1:5 with linespoints linewidth 1.8 pointtype 5 dashtype 2 \
       linecolor rgb '#d55e00' title 'critical damping, to restitution exp(−2)', \
     0.038/sqrt(x) with lines dashtype 3 linecolor rgb '#d55e00' title '1/√stiffness'
