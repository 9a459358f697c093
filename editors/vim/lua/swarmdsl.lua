-- Language server for Neovim 0.7 or later: require("swarmdsl").setup()
local M = {}

local defaults = {
  cmd = { "swarmc", "lsp" },
  on_attach = nil,
  capabilities = nil,
}
local clients = {} -- by root folder; for versions without vim.lsp.start

-- Folder of the project, else of the file.
local function root(file)
  local folder = vim.fn.fnamemodify(file, ":p:h")
  local project = vim.fn.findfile("swarm.toml", vim.fn.escape(folder, " ,;") .. ";")
  return project ~= "" and vim.fn.fnamemodify(project, ":p:h") or folder
end

local function attach(options, buffer)
  local folder = root(vim.api.nvim_buf_get_name(buffer))
  local config = {
    name = "swarmc",
    cmd = options.cmd,
    root_dir = folder,
    workspace_folders = { { uri = vim.uri_from_fname(folder), name = folder } },
    capabilities = options.capabilities or vim.lsp.protocol.make_client_capabilities(),
    on_attach = options.on_attach,
  }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = buffer })
    return
  end
  local id = clients[folder]
  if not id or not vim.lsp.get_client_by_id(id) then
    id = vim.lsp.start_client(config)
    clients[folder] = id
  end
  if id then
    vim.lsp.buf_attach_client(buffer, id)
  end
end

function M.setup(options)
  options = vim.tbl_extend("force", defaults, options or {})
  vim.api.nvim_create_autocmd("FileType", {
    pattern = "swarm",
    callback = function(args)
      attach(options, args.buf)
    end,
  })
end

return M
