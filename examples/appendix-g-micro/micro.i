Begin Sculpt
  input_micro = micro.tec
  exodus_file = micro
  micro_expand = 2
  pillow_surfaces = true
End Sculpt
