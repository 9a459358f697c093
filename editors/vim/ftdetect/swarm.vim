autocmd BufNewFile,BufRead *.swarm setfiletype swarm
