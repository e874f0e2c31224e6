solid bracket --about-z 20 --about-x 10 bracket.stl
sculpt -i capture.i -j 2
eputool -p 2 capture
